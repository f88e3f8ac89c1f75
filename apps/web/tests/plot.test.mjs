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

  async 'loads of many samples are told apart by color, and the key names each once'({ browser, address }) {
    const page = await newPage(browser);
    await page.goto(`${address}#/comparison?study=${kStudy}`);
    await settled(page);
    const panel = page.getByRole('region', { name: 'loads, Fy' });
    const entries = panel.locator('.key').first().getByRole('button');
    assert.deepEqual((await entries.allInnerTexts()).map((words) => words.trim()), ['Fz 530 N', 'Fz 1100 N']);
    const colors = await entries.locator('svg').evaluateAll((all) => all.map((svg) => getComputedStyle(svg).color));
    assert.notEqual(colors[0], colors[1]);
    await panel.getByText('points: measured, lines: simulated').waitFor();
    await panel.getByRole('application').first().focus();
    await page.keyboard.press('ArrowLeft');
    await panel.getByText('Fz 1100 N, gamma 2 deg, simulated: alpha 10 deg').waitFor();
    await page.context().close();
  },

  async 'numbers along an axis do not overlap'({ browser, address }) {
    const page = await newPage(browser);
    await page.addInitScript(() => {
      globalThis.drawnTexts = [];
      const draw = CanvasRenderingContext2D.prototype.fillText;
      CanvasRenderingContext2D.prototype.fillText = function (text, x, y) {
        const { e, f } = this.getTransform();
        globalThis.drawnTexts.push({ canvas: this.canvas.closest('section')?.ariaLabel, text, x: x + e, y: y + f, width: this.measureText(text).width, align: this.textAlign });
        draw.call(this, text, x, y);
      };
    });
    await page.goto(`${address}#/comparison?study=${kStudy}`);
    await settled(page);
    const texts = await page.evaluate(() => globalThis.drawnTexts.filter(({ canvas, align }) => canvas === 'shifts, Fx' && align === 'center'));
    const labels = texts.filter(({ text }) => /^\u2212?0\.00/.test(text));
    assert.ok(labels.length >= 3, JSON.stringify(texts));
    for (const one of labels)
      for (const other of labels)
        if (other.y === one.y && other.x > one.x) assert.ok(other.x - one.x > (one.width + other.width) / 2 + 4, `${one.text} ${other.text}`);
    await page.context().close();
  },

  async 'an interval with one end is drawn from there to the bound'({ browser, address }) {
    const page = await newPage(browser);
    await page.goto(`${address}#/identifiability?study=${kStudy}`);
    await settled(page);
    const rect = page.getByRole('row', { name: /^belt .*held at its bound/ }).locator('rect');
    const [from, width] = await rect.evaluate((node) => [Number(node.getAttribute('x')), Number(node.getAttribute('width'))]);
    assert.ok(from > 30, `it begins at ${from}`);
    assert.ok(Math.abs(from + width - 116) < 0.5, `it ends at ${from + width}`);
    await page.context().close();
  },

  async 'a key names nothing that is not drawn'({ browser, address }) {
    const page = await newPage(browser);
    await page.route('**/api/convergence*', async (route) => {
      const response = await route.fetch();
      await route.fulfill({ response, json: { ...(await response.json()), failed: [] } });
    });
    await page.goto(`${address}#/convergence?study=${kStudy}`);
    await settled(page);
    const key = page.locator('.key');
    await key.getByText('best so far').waitFor();
    assert.equal(await key.getByText('failed').count(), 0);
    await page.context().close();
  },
};
