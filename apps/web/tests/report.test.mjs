// SPDX-License-Identifier: Apache-2.0
// The page as a report: one file with its answers, its script and its style sheet, opened without a server.

import assert from 'node:assert/strict';
import { mkdtempSync, readFileSync, writeFileSync } from 'node:fs';
import { tmpdir } from 'node:os';
import { join } from 'node:path';
import { pathToFileURL } from 'node:url';
import { gzipSync } from 'node:zlib';

import { newPage, settled, violations } from './browser.mjs';
import * as data from './fixtures/data.mjs';
import { scene } from './fixtures/scene.mjs';

const kStudy = 'tire_b_twin/study.toml';

function reportOf(folder) {
  const none = new URLSearchParams();
  const answers = {
    study: data.study(kStudy), convergence: data.convergence(kStudy, none), trials: data.trials(kStudy, new URLSearchParams({ order: 'target' })),
    comparison: data.comparison(kStudy), limits: data.limits(kStudy), target: data.target(kStudy, none), kpis: data.kpis(kStudy, none), identifiability: data.identifiability(kStudy),
    model: data.model(), section: data.section(), scene: { gzip_base64: gzipSync(scene()).toString('base64') }, 'trial?trial=12': data.trial(kStudy, 12),
  };
  const inside = (name) => readFileSync(join(folder, 'report', name), 'utf8');
  const json = JSON.stringify(answers).replaceAll('<', '\\u003c');
  const script = inside('report.js');
  assert.ok(!script.includes('</script'), 'it can stand in a page');
  const page = `<!doctype html><html lang="en"><head><meta charset="utf-8"><title>Report</title><style>${inside('report.css')}</style></head><body><div id="studio"></div><script type="application/json" id="answers">${json}</script><script>${script}</script></body></html>`;
  const file = join(mkdtempSync(join(tmpdir(), 'latsch_report_')), 'report.html');
  writeFileSync(file, page);
  return file;
}

export const claims = {
  async 'every view of a report is shown from its file alone'({ browser, folder }) {
    const file = reportOf(folder);
    const page = await newPage(browser);
    const asked = [];
    page.on('request', (request) => { if (!request.url().startsWith('file:')) asked.push(request.url()); });
    const faults = [];
    for (const view of ['study', 'model', 'convergence', 'target', 'comparison', 'kpis', 'identifiability']) {
      await page.goto(`${pathToFileURL(file).href}#/${view}`);
      await page.reload();
      await settled(page);
      await page.waitForSelector('.panel');
      if (view === 'comparison') await page.getByText('above FZMAX').waitFor();
      if (view === 'model') await page.waitForSelector('canvas');
      faults.push(...[...(await violations(page)), ...page.errors.splice(0), ...(await page.getByRole('alert').allInnerTexts())].map((words) => `${view}: ${words}`));
    }
    await page.context().close();
    assert.deepEqual(faults, []);
    assert.deepEqual(asked, []);
    return `${Math.round(readFileSync(file).length / 1e3)} KB`;
  },
};
