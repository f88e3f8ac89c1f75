// SPDX-License-Identifier: Apache-2.0
// Runs the tests of the page in a browser, against answers in the shapes of docs/studio.md: node tests/run.mjs [NAME]
// Each file x.test.mjs exports its claims; a claim that does not hold throws. The page must be built already.

import { existsSync, readdirSync } from 'node:fs';
import { dirname, join } from 'node:path';
import { fileURLToPath } from 'node:url';

import { openBrowser } from './browser.mjs';
import { serve } from './fixtures/server.mjs';

const here = dirname(fileURLToPath(import.meta.url));
const folder = process.env.LATSCH_WEB_OUT ?? join(here, '..', 'dist');
if (!existsSync(join(folder, 'index.html'))) throw new Error(`run.mjs: ${folder} has no page; run npm run build first`);

const only = process.argv[2] ?? '';
const site = await serve(folder);
const browser = await openBrowser();
let failed = 0;
for (const file of readdirSync(here).filter((name) => name.endsWith('.test.mjs')).sort()) {
  const { claims } = await import(join(here, file));
  for (const [claim, holds] of Object.entries(claims)) {
    if (!`${file} ${claim}`.includes(only)) continue;
    const begin = performance.now();
    try {
      const told = await holds({ browser, address: site.address, folder });
      console.log(`ok      ${file.replace('.test.mjs', '')}: ${claim}${told ? ` (${told})` : ''}, ${Math.round(performance.now() - begin)} ms`);
    } catch (error) {
      failed += 1;
      console.log(`FAILED  ${file.replace('.test.mjs', '')}: ${claim}\n${error.stack ?? error}`);
    }
  }
}
await browser.close();
site.end();
console.log(failed ? `${failed} claims do not hold` : 'all claims hold');
process.exit(failed ? 1 : 0);
