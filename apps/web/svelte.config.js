// SPDX-License-Identifier: Apache-2.0
// Options of Svelte's compiler and checker: styles are written to files of their own, as the server's policy requires.
export default { compilerOptions: { css: 'external', runes: true } };
