// SPDX-License-Identifier: Apache-2.0
// What Svelte's compiler and its checker are told: styles leave in files of their own, as the server's policy asks.
export default { compilerOptions: { css: 'external', runes: true } };
