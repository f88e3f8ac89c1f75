// SPDX-License-Identifier: Apache-2.0
// Samples of the posterior: intervals beside the linear ones, the verdict in words, plots of the chosen variables' pairs.

import assert from 'node:assert/strict';

import { newPage, settled } from './browser.mjs';

export const claims = {
  async 'samples stand beside the linear intervals, and pairs are drawn as chosen'({ browser, address }) {
    const page = await newPage(browser);
    await page.goto(`${address}#/identifiability?study=tire_b_twin/study.toml`);
    await settled(page);
    await page.getByText('The surrogate is doubtful').waitFor();
    const row = page.getByRole('row', { name: /banana with matrix/ });
    assert.match(await row.innerText(), /carcass/);
    const plots = () => page.locator('[aria-label^="Samples of"]').evaluateAll((all) => [...new Set(all.map((one) => one.getAttribute('aria-label').split('. ')[0]))]);
    assert.deepEqual(await plots(), ['Samples of matrix', 'Samples of carcass', 'Samples of matrix and carcass']);
    const choices = page.getByRole('group', { name: 'Variables of the plots' });
    assert.deepEqual((await choices.locator('label').allInnerTexts()).map((words) => words.trim()), ['carcass', 'matrix'], 'the most unlike first, none without draws');
    await choices.getByLabel('matrix').uncheck();
    await settled(page);
    assert.deepEqual(await plots(), ['Samples of carcass']);
    assert.deepEqual(page.errors, []);
    await page.context().close();
  },

  async 'bands from samples stand beside the linear ones'({ browser, address }) {
    const page = await newPage(browser);
    await page.goto(`${address}#/identifiability?study=tire_b_twin/study.toml`);
    await settled(page);
    await page.locator('[aria-label^="Bands of stiffness"]').first().waitFor();
    assert.deepEqual(page.errors, []);
    await page.context().close();
  },
};
