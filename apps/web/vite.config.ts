// SPDX-License-Identifier: Apache-2.0
// The page of the server: a first script, further ones when they are needed (what draws in space), one style sheet.
import { svelte } from '@sveltejs/vite-plugin-svelte';
import { defineConfig } from 'vite';

import { drawnByProcessor } from './tools/drawn_by_processor.mjs';

export default defineConfig({
  plugins: [drawnByProcessor(), svelte()],
  base: '/',
  build: {
    outDir: process.env.LATSCH_WEB_OUT ?? 'dist',
    emptyOutDir: true,
    target: 'es2022',
    rollupOptions: { output: { experimentalMinChunkSize: 12000 } }, // bytes: smaller scripts go with one that needs them
    cssCodeSplit: false,
    modulePreload: { polyfill: false },
    assetsInlineLimit: 0, // the policy allows no data: addresses
    chunkSizeWarningLimit: 700,
  },
});
