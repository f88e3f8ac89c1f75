// SPDX-License-Identifier: Apache-2.0
// `npm run dev`: Vite's server with the sources of the page; /api and /events are answered from the fixtures of the
// tests.
import { svelte } from '@sveltejs/vite-plugin-svelte';
import { defineConfig } from 'vite';

import { handle } from './fixtures/server.mjs';

const fixtures = {
  name: 'latsch-fixtures',
  configureServer(server) {
    server.middlewares.use((request, response, next) => {
      if (/^\/(api|events)\b/.test(request.url)) handle(request, response);
      else next();
    });
  },
};

export default defineConfig({ plugins: [svelte(), fixtures] });
