// SPDX-License-Identifier: Apache-2.0
// Every view, light and dark, is free of violations by axe and of errors in the console.

import assert from 'node:assert/strict';

import { newPage, settled, violations } from './browser.mjs';
import { kViews } from './views.mjs';

const allOf = (scheme) => async ({ browser, address }) => {
  const page = await newPage(browser, { scheme });
  const faults = [];
  for (const [name, hash] of kViews) {
    await page.goto(address + hash);
    await page.reload();
    await settled(page);
    const missing = name === 'missing'; // the browser itself reports its 404
    const errors = page.errors.splice(0).filter((words) => !missing || !words.includes('404'));
    faults.push(...[...(await violations(page)), ...errors].map((words) => `${name}: ${words}`));
  }
  await page.context().close();
  assert.deepEqual(faults, []);
  return `${kViews.length} views`;
};

export const claims = {
  'no violation of axe and no console error, light': allOf('light'),
  'no violation of axe and no console error, dark': allOf('dark'),

  async 'what draws in space is not loaded before something is shown in space'({ browser, address }) {
    const page = await newPage(browser);
    const asked = [];
    page.on('request', (request) => asked.push(request.url()));
    await page.goto(`${address}#/target?study=tire_b_twin/study.toml`);
    await settled(page);
    const inSpace = (url) => /(stage|Space)-/.test(url); // the script that draws in space, by the names of its parts
    assert.ok(!asked.some(inSpace), asked.join('\n'));
    await page.getByRole('button', { name: '3-D' }).click();
    await page.waitForSelector('canvas');
    assert.ok(asked.some(inSpace));
    assert.ok(asked.every((url) => url.startsWith(address)), 'it asks no other host');
    await page.waitForTimeout(500);
    assert.deepEqual(page.errors, []);
    await page.context().close();
  },
};
