// SPDX-License-Identifier: Apache-2.0
// Measures the page with a journal of 50 000 trials: the time until its convergence is drawn, and for each redraw.
// Works for a page at any address, so that a benchmark measures the real server with it.

import { newPage, settled } from './browser.mjs';

/** Waits until the first drawing is on the screen: without a graphics processor a browser uses a later frame for it. */
const shown = (page) =>
  page.evaluate(async () => {
    for (let k = 0; k < 3; ++k) await new Promise((resolve) => requestAnimationFrame(() => setTimeout(resolve, 0)));
  });

/** Milliseconds from the address to the drawn convergence of a study. */
export async function loadTime(browser, address, study) {
  const page = await newPage(browser);
  const begin = performance.now();
  await page.goto(`${address}#/convergence?study=${study}`);
  await page.waitForSelector('.u-wrap canvas');
  await settled(page);
  await shown(page);
  const took = performance.now() - begin;
  await page.context().close();
  return took;
}

/** Milliseconds of the longest of several drawings of the convergence, from the click to the drawn frame. */
export async function redrawTime(browser, address, study) {
  const page = await newPage(browser);
  await page.goto(`${address}#/convergence?study=${study}`);
  await page.waitForSelector('.u-wrap canvas');
  await settled(page);
  await shown(page);
  const longest = await page.evaluate(async () => {
    const entry = [...document.querySelectorAll('.key button')].find((button) => button.textContent.includes('best so far'));
    let longest = 0;
    for (let k = 0; k < 7; ++k) {
      const begin = performance.now();
      entry.click();
      await new Promise((resolve) => requestAnimationFrame(() => setTimeout(resolve, 0)));
      longest = Math.max(longest, performance.now() - begin);
    }
    return longest;
  });
  await page.context().close();
  return longest;
}

/** Processor time of the page so far, ms, which does not depend on the load of the machine. */
async function meter(page) {
  const tools = await page.context().newCDPSession(page);
  await tools.send('Performance.enable', { timeDomain: 'threadTicks' });
  return async () => 1000 * (await tools.send('Performance.getMetrics')).metrics.find(({ name }) => name === 'TaskDuration').value;
}

/** Milliseconds of processor time until the convergence is drawn, and for one further drawing. */
export async function work(browser, address, study) {
  const page = await newPage(browser);
  const worked = await meter(page);
  await page.goto(`${address}#/convergence?study=${study}`);
  await page.waitForSelector('.u-wrap canvas');
  await settled(page);
  const load = await worked();
  const times = 8;
  await page.evaluate(async (count) => {
    const entry = [...document.querySelectorAll('.key button')].find((button) => button.textContent.includes('best so far'));
    for (let k = 0; k < count; ++k) {
      entry.click();
      await new Promise((resolve) => requestAnimationFrame(() => setTimeout(resolve, 0)));
    }
  }, times);
  const redraw = ((await worked()) - load) / times;
  await page.context().close();
  return { load, redraw };
}

/** Milliseconds from `act`, which ends a trial, to the point's appearance on the page. */
export async function firstPointTime(page, act) {
  const count = () => page.evaluate(() => document.querySelector('.panel header .small-print')?.textContent ?? '');
  const before = await count();
  const begin = performance.now();
  await act();
  await page.waitForFunction((words) => (document.querySelector('.panel header .small-print')?.textContent ?? '') !== words, before, { polling: 10, timeout: 30000 });
  return performance.now() - begin;
}
