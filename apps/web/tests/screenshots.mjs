// SPDX-License-Identifier: Apache-2.0
// Takes pictures of every view, light and dark, to be looked at: node tests/screenshots.mjs [FOLDER [VIEW ...]]; FOLDER
// is screenshots by default. Reports errors of the console and violations found by axe.

import { mkdirSync } from 'node:fs';

import { newPage, openBrowser, settled, violations } from './browser.mjs';
import { serve } from './fixtures/server.mjs';
import { kViews } from './views.mjs';

const [folder = 'screenshots', ...only] = process.argv.slice(2);
mkdirSync(folder, { recursive: true });
const site = await serve(process.env.LATSCH_WEB_OUT ?? 'dist');
const browser = await openBrowser();
for (const scheme of ['light', 'dark']) {
  const page = await newPage(browser, { scheme });
  for (const [name, hash] of kViews) {
    if (only.length && !only.includes(name)) continue;
    await page.goto(site.address + hash);
    await page.reload();
    await settled(page);
    await page.waitForTimeout(300);
    const height = await page.evaluate(() => document.documentElement.scrollHeight);
    await page.setViewportSize({ width: 1440, height: Math.max(height, 900) }); // sticky elements stay at the end of
                                                                                // the page
    await page.waitForTimeout(200);
    await page.screenshot({ path: `${folder}/${name}_${scheme}.png` });
    await page.setViewportSize({ width: 1440, height: 900 });
    for (const words of [...(await violations(page)), ...page.errors.splice(0)]) console.log(`${name} ${scheme}: ${words}`);
  }
  await page.context().close();
}
await browser.close();
site.end();
