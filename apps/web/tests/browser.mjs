// SPDX-License-Identifier: Apache-2.0
// A browser for the tests: Debian's chromium, or the one that CHROMIUM names. Every page collects the errors of its
// console, because a page must have none.

import { existsSync, readFileSync } from 'node:fs';
import { createRequire } from 'node:module';

import { chromium } from 'playwright-core';

const kPaths = [process.env.CHROMIUM, '/usr/bin/chromium', '/usr/bin/chromium-browser', '/usr/bin/google-chrome'];
const axeScript = readFileSync(createRequire(import.meta.url).resolve('axe-core/axe.min.js'), 'utf8');

export async function openBrowser() {
  const executablePath = kPaths.find((path) => path && existsSync(path));
  if (!executablePath) throw new Error('browser.mjs: no chromium found; install the package chromium or set CHROMIUM');
  return chromium.launch({ executablePath, args: ['--no-sandbox', '--use-gl=angle', '--use-angle=swiftshader', '--enable-unsafe-swiftshader', '--ignore-gpu-blocklist'] });
}

export async function newPage(browser, { scheme = 'light', width = 1440, height = 900 } = {}) {
  const context = await browser.newContext({ colorScheme: scheme, viewport: { width, height }, reducedMotion: 'reduce' });
  const page = await context.newPage();
  page.errors = [];
  page.on('console', (message) => { if (message.type() === 'error') page.errors.push(message.text()); });
  page.on('pageerror', (error) => page.errors.push(String(error)));
  return page;
}

/** Waits until everything is loaded and drawn. */
export async function settled(page) {
  await page.waitForFunction(() => !document.querySelector('.loading, footer .waiting, [aria-busy=true]') && !document.body.innerText.includes('Loading the'), null, { timeout: 30000 });
  await page.evaluate(() => new Promise((resolve) => requestAnimationFrame(() => requestAnimationFrame(resolve))));
}

/** Returns violations found by axe, in words. */
export async function violations(page) {
  await page.evaluate(`(() => { const module = undefined, exports = undefined, define = undefined; ${axeScript}\n})()`);
  const { violations: found } = await page.evaluate(() => globalThis.axe.run(document, { resultTypes: ['violations'] }));
  return found.flatMap((rule) => rule.nodes.map((node) => `${rule.id}: ${node.target.join(' ')}: ${node.failureSummary?.split('\n').slice(1, 3).join(' ')}`));
}
