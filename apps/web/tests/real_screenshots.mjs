// SPDX-License-Identifier: Apache-2.0
// Takes pictures of every view of studies on a real server, to be looked at:
//   node tests/real_screenshots.mjs ADDRESS_WITH_TOKEN FOLDER STUDY [VIEW ...]
// Reports errors of the console and violations found by axe.

import { mkdirSync } from 'node:fs';

import { newPage, openBrowser, settled, violations } from './browser.mjs';

const [address, folder, study, ...only] = process.argv.slice(2);
mkdirSync(folder, { recursive: true });
const browser = await openBrowser();
const scheme = process.env.SCHEME ?? 'light';
const page = await newPage(browser, { scheme });
await page.goto(address);
const origin = new URL(address).origin;
const views = only.length ? only : ['home', 'study', 'setup', 'model', 'convergence', 'target', 'comparison', 'kpis', 'identifiability'];
for (const view of views) {
  await page.goto(`${origin}/#/${view}${view === 'home' ? '' : `?study=${study}`}`);
  await page.reload();
  try {
    await settled(page);
  } catch {
    console.log(`${view}: still loading after half a minute`);
  }
  await page.waitForTimeout(400);
  const height = await page.evaluate(() => document.documentElement.scrollHeight);
  await page.setViewportSize({ width: 1440, height: Math.min(Math.max(height, 900), 5000) });
  await page.waitForTimeout(300);
  await page.screenshot({ path: `${folder}/${study.replaceAll('/', '_')}_${view}_${scheme}.png` });
  await page.setViewportSize({ width: 1440, height: 900 });
  for (const words of [...(await violations(page)), ...page.errors.splice(0)]) console.log(`${view}: ${words}`);
}
await browser.close();
