// SPDX-License-Identifier: Apache-2.0
// A plot draws the data of the page: after a click on its key, after new trials, after a change of the window's width.

import assert from 'node:assert/strict';

import { newPage, settled } from './browser.mjs';
import { publish } from './fixtures/server.mjs';

const kStudy = 'tire_b_twin/study.toml';

async function open(browser, address) {
  const page = await newPage(browser);
  page.asked = [];
  page.on('request', (request) => { if (request.url().includes('/api/')) page.asked.push(new URL(request.url()).pathname); });
  await page.goto(`${address}#/convergence?study=${kStudy}`);
  await settled(page);
  return page;
}

/** The pixels of the first plot as a text, which differs if they do. */
const pixels = (page) => page.locator('.u-wrap canvas').first().evaluate((canvas) => canvas.toDataURL());

const drawnAnew = (page, before) =>
  page.waitForFunction((old) => document.querySelector('.u-wrap canvas').toDataURL() !== old, before, { timeout: 5000 });

export const claims = {
  async 'what the key hides goes from the drawing, and comes back'({ browser, address }) {
    const page = await open(browser, address);
    const all = await pixels(page);
    const entry = page.getByRole('button', { name: 'best so far' });
    await entry.click();
    await drawnAnew(page, all);
    const less = await pixels(page);
    await entry.click();
    await drawnAnew(page, less);
    assert.equal(await pixels(page), all);
    await page.context().close();
  },

  async 'a trial that comes is drawn'({ browser, address }) {
    const page = await open(browser, address);
    await page.getByText('Server is alive').waitFor();
    const before = await pixels(page);
    publish('trials', { study: kStudy, total: 421, failed: 6, is_many: false, best: { trial: 421, target: 1e-5 }, rows: [{ trial: 421, target: 1e-5 }] });
    await drawnAnew(page, before);
    await page.context().close();
  },

  async 'a plot is as wide as its place, whatever the window was before'({ browser, address }) {
    const page = await open(browser, address);
    for (const width of [1000, 1440]) {
      await page.setViewportSize({ width, height: 900 });
      await page.waitForFunction(() => {
        const canvas = document.querySelector('.u-wrap canvas');
        return canvas.width === Math.floor(canvas.closest('.canvas').clientWidth * devicePixelRatio);
      }, null, { timeout: 5000 });
    }
    await page.context().close();
  },

  async 'it is drawn in the color of the other theme once that is chosen'({ browser, address }) {
    const page = await open(browser, address);
    const light = await pixels(page);
    await page.getByRole('button', { name: 'Dark' }).click();
    await drawnAnew(page, light);
    await page.context().close();
  },

  async 'every question is asked once'({ browser, address }) {
    const page = await open(browser, address);
    assert.deepEqual(page.asked.sort(), ['/api/convergence', '/api/study']);
    await page.context().close();
  },
};
