// SPDX-License-Identifier: Apache-2.0
// Builds the page's components for a report in one file: report.js and report.css, which need no other files.
import { svelte } from '@sveltejs/vite-plugin-svelte';
import { defineConfig } from 'vite';

import { drawnByProcessor } from './tools/drawn_by_processor.mjs';

export default defineConfig({
  plugins: [drawnByProcessor(), svelte()],
  build: {
    outDir: `${process.env.LATSCH_WEB_OUT ?? 'dist'}/report`,
    emptyOutDir: true,
    target: 'es2022',
    cssCodeSplit: false,
    copyPublicDir: false,
    chunkSizeWarningLimit: 1200,
    rollupOptions: {
      input: 'src/report.ts',
      output: {
        format: 'iife',
        inlineDynamicImports: true,
        entryFileNames: 'report.js',
        assetFileNames: 'report[extname]',
      },
    },
  },
});
