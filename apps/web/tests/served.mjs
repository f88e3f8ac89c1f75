// SPDX-License-Identifier: Apache-2.0
// The page on a real `latsch serve`: a study is set up, run, watched by a second page, weighted anew, and looked at in
// every view: node tests/served.mjs LATSCH STUDIES, where STUDIES is the folder studies of the sources.

import assert from 'node:assert/strict';
import { spawn } from 'node:child_process';
import { cpSync, mkdirSync, mkdtempSync, readFileSync, rmSync } from 'node:fs';
import { tmpdir } from 'node:os';
import { join } from 'node:path';

import { newPage, openBrowser, settled, violations } from './browser.mjs';

const [latsch, studies] = process.argv.slice(2);
const kStudy = 'corner/study.toml';
const folder = mkdtempSync(join(tmpdir(), 'latsch_served_'));
mkdirSync(join(folder, 'corner'));
for (const file of ['study.toml', 'corner.toml']) cpSync(join(studies, 'compliance', file), join(folder, 'corner', file));
const textOf = () => readFileSync(join(folder, kStudy), 'utf8');

function start() {
  const server = spawn(latsch, ['serve', folder, '--no-browser'], { stdio: ['ignore', 'pipe', 'inherit'] });
  return new Promise((resolve, reject) => {
    let told = '';
    server.stdout.on('data', (bytes) => {
      told += bytes;
      const address = /http:\S+token=\S+/.exec(told);
      if (address) resolve({ server, address: address[0] });
    });
    server.on('exit', () => reject(new Error(`latsch serve ended: ${told}`)));
  });
}

const { server, address } = await start();
const browser = await openBrowser();
const page = await newPage(browser);
await page.goto(address);
const { origin } = new URL(page.url());
assert.equal(new URL(page.url()).search, '', 'the token has left the address bar');

async function open(on, view) {
  await on.goto(`${origin}/#/${view}?study=${kStudy}`);
  await on.waitForFunction(() => document.querySelector('main')?.innerText.length > 0);
  await settled(on);
}

const steps = {
  async 'the study is listed'() {
    await page.getByRole('link', { name: 'Compliance of a front corner' }).waitFor();
  },
  async 'the form changes the file, the check says that it can be run'() {
    await open(page, 'setup');
    await page.getByText('The study can be run.').waitFor();
    await page.getByLabel('lower of uca_front').fill('3');
    await page.getByLabel('lower of uca_front').press('Tab');
    await page.waitForFunction(() => document.querySelector('textarea').value.includes('lower = "3 kN/mm"'));
    assert.match(textOf(), /variable.uca_front = .*lower = "3 kN\/mm"/);
    await page.getByText('The study can be run.').waitFor();
  },
  async 'what is wrong is said while it is typed'() {
    const text = page.getByLabel('The study file');
    await text.fill(textOf().replace('"3 kN/mm"', '"3 kN"'));
    await page.getByText('The study cannot be run yet.').waitFor();
    await page.getByRole('button', { name: 'Discard' }).click();
    await page.getByText('The study can be run.').waitFor();
  },
  async 'a click makes a number of the model a variable'() {
    await open(page, 'model');
    await page.getByRole('searchbox').fill('hardpoint.ubj.0');
    await page.getByRole('button', { name: 'Vary hardpoint.ubj.0' }).click();
    await page.getByLabel('name').fill('ubj_x');
    await page.getByLabel('lower').fill('1500');
    await page.getByLabel('upper').fill('1520');
    await page.getByRole('button', { name: 'Write it into the study file' }).click();
    await page.getByText('varies as ubj_x').waitFor();
    assert.match(textOf(), /\[variable.ubj_x\]/);
  },
  async 'a run that one page starts is seen by another, point by point'() {
    const other = await newPage(browser);
    await other.goto(address);
    await open(other, 'convergence');
    await other.getByText('No trial yet').waitFor();
    await open(page, 'study');
    await page.getByRole('button', { name: 'Start' }).click();
    await other.waitForSelector('.u-wrap canvas', { timeout: 60000 });
    await page.locator('.about').getByText('ended').waitFor({ timeout: 120000 });
    await other.waitForFunction(() => Number.parseInt(document.querySelector('.panel header .small-print').textContent, 10) >= 10, null, { timeout: 30000 });
    assert.deepEqual(other.errors, []);
    await other.context().close();
  },
  async 'a weight that is tried changes the targets'() {
    await open(page, 'kpis');
    const target = () => page.locator('section[aria-label="The target"] strong').nth(1).textContent();
    const before = await target();
    await page.getByLabel('Weight of A_dz').fill('5');
    await page.getByLabel('Weight of A_dz').press('Tab');
    await page.waitForURL(/weights=/);
    await settled(page);
    assert.notEqual(await target(), before);
  },
  async 'every view shows its study: no error, no violation of axe'() {
    const faults = [];
    for (const view of ['study', 'setup', 'model', 'convergence', 'target', 'comparison', 'kpis', 'identifiability']) {
      await open(page, view);
      await page.waitForSelector('.panel');
      const alerts = await page.getByRole('alert').allInnerTexts();
      faults.push(...[...alerts, ...(await violations(page)), ...page.errors.splice(0)].map((words) => `${view}: ${words}`));
    }
    assert.deepEqual(faults, []);
  },
};

let failed = false;
for (const [step, act] of Object.entries(steps)) {
  try {
    await act();
    console.log(`ok      ${step}`);
  } catch (error) {
    console.log(`FAILED  ${step}\n${error.stack}`);
    await page.screenshot({ path: join(folder, '..', 'latsch_served_failed.png') });
    failed = true;
    break;
  }
}
await browser.close();
server.removeAllListeners('exit');
server.kill('SIGINT');
rmSync(folder, { recursive: true, force: true });
process.exit(failed ? 1 : 0);
