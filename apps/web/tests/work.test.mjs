// SPDX-License-Identifier: Apache-2.0
// Actions of a person on the page result in requests of the contract, and in the display afterwards.

import assert from 'node:assert/strict';

import { newPage, settled } from './browser.mjs';
import { kText, state } from './fixtures/data.mjs';
import { publish } from './fixtures/server.mjs';

const kStudy = 'tire_b_twin/study.toml';

async function open(browser, address, hash) {
  const page = await newPage(browser);
  page.asked = [];
  page.on('request', (request) => { if (request.url().includes('/api/')) page.asked.push({ url: request.url(), body: request.postDataJSON() }); });
  await page.goto(address + hash);
  await settled(page);
  return page;
}

const forget = () => { state.file = { text: kText, version: 'v1' }; };

export const claims = {
  async 'a changed weight asks for all targets with it, and is written into the file when asked to'({ browser, address }) {
    forget();
    const page = await open(browser, address, `#/kpis?study=${kStudy}`);
    const before = await page.locator('section[aria-label="The target"] strong').nth(1).textContent();
    await page.getByLabel('Weight of stiffness').fill('3');
    await page.getByLabel('Weight of stiffness').press('Tab');
    await page.waitForURL(/weights=stiffness:3/);
    await settled(page);
    assert.ok(page.asked.some(({ url }) => url.includes('kpis') && url.includes('weights=stiffness%3A3')));
    assert.notEqual(await page.locator('section[aria-label="The target"] strong').nth(1).textContent(), before);
    await page.getByRole('button', { name: 'Write them into the study file' }).click();
    await page.waitForFunction(() => !location.hash.includes('weights='));
    assert.match(state.file.text, /\[experiment.stiffness\][^[]*weight = 3/);
    await page.context().close();
  },

  async 'a click makes a number of the model a variable of the file'({ browser, address }) {
    forget();
    const page = await open(browser, address, `#/model?study=${kStudy}`);
    await page.getByRole('button', { name: 'Vary rubber.tread.young_modulus' }).click();
    await page.getByLabel('upper').fill('5');
    assert.equal(await page.getByRole('button', { name: 'Write it into the study file' }).isDisabled(), true);
    await page.getByLabel('upper').fill('50');
    await page.getByRole('button', { name: 'Write it into the study file' }).click();
    await page.waitForSelector('dialog', { state: 'detached' });
    assert.match(state.file.text, /\[variable.tread_young_modulus\]\npath = "rubber.tread.young_modulus"\nlower = "11.15 N\/mm\^2"\nupper = "50 N\/mm\^2"/);
    assert.deepEqual(page.errors, []);
    await page.context().close();
  },

  async 'a page that is hidden follows nothing, and asks anew when it is looked at'({ browser, address }) {
    forget();
    const page = await newPage(browser);
    await page.addInitScript(() => {
      const Real = EventSource;
      globalThis.followed = new Set();
      globalThis.EventSource = class extends Real {
        constructor(...of) { super(...of); globalThis.followed.add(this); }
        close() { super.close(); globalThis.followed.delete(this); }
      };
    });
    await page.goto(`${address}#/study?study=${kStudy}`);
    await settled(page);
    const show = (isHidden) => page.evaluate((hidden) => {
      Object.defineProperty(document, 'hidden', { configurable: true, get: () => hidden });
      document.dispatchEvent(new Event('visibilitychange'));
      return globalThis.followed.size;
    }, isHidden);
    assert.equal(await page.evaluate(() => globalThis.followed.size), 1);
    assert.equal(await show(true), 0);
    const asked = page.waitForRequest((request) => request.url().includes('/api/study?'));
    assert.equal(await show(false), 1);
    await asked;
    await page.getByText('Server is alive').waitFor();
    assert.deepEqual(page.errors, []);
    await page.context().close();
  },

  async 'a test is gone through step by step, by keys too, with its forces as numbers'({ browser, address }) {
    forget();
    const page = await open(browser, address, '#/model?study=compliance/study.toml');
    const slider = page.getByLabel('State of the rig');
    await slider.waitFor();
    await page.getByText('Of 28 tests the first 2 are shown step by step.').waitFor();
    assert.equal(await slider.inputValue(), '9'); // largest forces
    await slider.press('ArrowLeft');
    await page.getByText('Fy 3200 N, state 9 of 10').waitFor();
    await page.getByText('Forces as numbers').click();
    await page.getByRole('row', { name: 'lower joint 10400 0 10400 0 N 10400 N tension' }).waitFor();
    await page.getByRole('row', { name: 'moment on the wheel 80 0 0 80 N m' }).waitFor();
    await page.getByLabel('displacements drawn').selectOption('50');
    await page.getByText('Displacements are drawn 50 times').waitFor();
    await page.locator('.state select').selectOption({ label: 'over a step' });
    const time = page.getByLabel('Time of the run');
    await time.fill('0');
    await page.getByText('time 0 s').waitFor();
    await page.getByRole('button', { name: 'Play' }).click();
    await page.waitForFunction(() => document.querySelector('[aria-label="Time of the run"]').value !== '0');
    await page.getByRole('button', { name: 'Hold' }).click();
    assert.deepEqual(page.errors, []);
    await page.context().close();
  },

  async 'form and text edit the same file, and what is wrong is said while it is typed'({ browser, address }) {
    forget();
    const page = await open(browser, address, `#/setup?study=${kStudy}`);
    await page.getByLabel('lower of matrix').fill('7');
    await page.getByLabel('lower of matrix').press('Tab');
    await page.waitForFunction(() => document.querySelector('textarea').value.includes('lower = "7 N/mm^2"'));
    const text = page.getByLabel('The study file');
    await text.fill(state.file.text.replace('"1000 N/mm^2"', '"1000 N"'));
    await page.getByText('The study cannot be run yet.').waitFor();
    assert.equal(await page.locator('fieldset').evaluate((form) => form.disabled), true);
    await page.getByRole('button', { name: /^line 2\d$/ }).click();
    assert.equal(await text.evaluate((area) => area.value.slice(area.selectionStart, area.selectionEnd)), 'lower = "1000 N"');
    await text.press('Control+s');
    await page.waitForFunction(() => [...document.querySelectorAll('button')].find((button) => button.textContent === 'Save').disabled);
    assert.match(state.file.text, /"1000 N"/);
    await page.context().close();
  },

  async 'the form offers the choices that the program states, with their meaning'({ browser, address }) {
    forget();
    const page = await open(browser, address, `#/setup?study=${kStudy}`);
    const method = page.locator('label', { has: page.getByText('method', { exact: true }) }).locator('select');
    await page.waitForFunction(() => [...document.querySelectorAll('.keys select')].length === 4);
    assert.deepEqual(await method.locator('option').allTextContents(), ['default', 'auto', 'gss', 'nelder_mead']);
    await method.selectOption('gss');
    await page.waitForFunction(() => document.querySelector('textarea').value.includes('method = "gss"'));
    assert.equal(await page.locator('label', { hasText: 'after a failure' }).getAttribute('title'), 'What a failed trial does.');
    await page.context().close();
  },

  async 'what another program has written meanwhile is overwritten only when asked to'({ browser, address }) {
    forget();
    const page = await open(browser, address, `#/setup?study=${kStudy}`);
    const text = page.getByLabel('The study file');
    await text.fill(`${kText}# mine\n`);
    state.file = { text: `${kText}# theirs\n`, version: 'other' };
    await page.getByRole('button', { name: 'Save' }).click();
    await page.getByText('has been changed by another program').waitFor();
    assert.match(state.file.text, /# theirs/);
    await page.getByRole('button', { name: 'Write mine over it' }).click();
    await page.waitForFunction(() => !document.body.innerText.includes('has been changed by another program'));
    assert.match(state.file.text, /# mine/);
    assert.deepEqual(page.errors.filter((words) => !words.includes('409')), []);
    await page.context().close();
  },

  async 'a trial that ends is a point at once, and the server is said to be alive'({ browser, address }) {
    const page = await open(browser, address, `#/convergence?study=${kStudy}`);
    await page.getByText('Server is alive').waitFor();
    const told = (count) => page.waitForFunction((words) => document.querySelector('.panel header').innerText.includes(words), `${count} trials`);
    await told(420);
    const begin = performance.now();
    publish('trials', { study: kStudy, total: 421, failed: 6, is_many: false, best: { trial: 421, target: 0.0012 }, rows: [{ trial: 421, target: 0.0012 }] });
    await told(421);
    const took = Math.round(performance.now() - begin);
    assert.ok(took < 1000, `${took} ms`);
    await page.context().close();
    return `${took} ms after the event`;
  },

  async 'a point of the convergence opens its trial by keys'({ browser, address }) {
    const page = await open(browser, address, `#/convergence?study=${kStudy}`);
    await page.getByRole('application').focus();
    for (const key of ['ArrowRight', 'ArrowRight', 'ArrowRight', 'Enter']) await page.keyboard.press(key);
    await page.getByRole('heading', { name: 'Trial 3' }).waitFor();
    await page.keyboard.press('Escape');
    await page.waitForFunction(() => !document.querySelector('aside'));
    await page.context().close();
  },

  async 'a run is started and stopped'({ browser, address }) {
    const page = await open(browser, address, '#/study?study=fresh/study.toml');
    await page.getByRole('button', { name: 'Start' }).click();
    await page.getByRole('button', { name: 'Stop' }).waitFor();
    await page.getByRole('button', { name: 'Stop' }).click();
    await page.getByRole('button', { name: 'Start' }).waitFor();
    assert.deepEqual(page.asked.filter(({ body }) => body).map(({ body }) => body), [{ study: 'fresh/study.toml', verb: 'run', anew: false }, { study: 'fresh/study.toml' }]);
    await page.context().close();
  },

  async 'two studies are chosen and compared'({ browser, address }) {
    const page = await open(browser, address, '#/home');
    await page.getByLabel('Compare Tire B twin').check();
    await page.getByLabel('Compare Compliance').check();
    await page.getByRole('link', { name: 'Compare the two' }).click();
    await page.getByRole('heading', { name: 'Two studies' }).waitFor();
    await page.getByRole('heading', { name: 'Errors of the experiments' }).waitFor();
    await page.getByText('No intervals of the second: the trials around the best point are missing').waitFor();
    await page.getByRole('row', { name: 'cleat_60' }).getByText('not in this study').waitFor();
    await page.getByRole('table').first().getByText('not varied').waitFor();
    await page.context().close();
  },

  async 'an answer in the shape of an error is told with what, why and what next'({ browser, address }) {
    const page = await open(browser, address, '#/study?study=gone/study.toml');
    const words = await page.getByRole('alert').innerText();
    assert.match(words, /there is no study gone\/study\.toml/);
    assert.match(words, /list of studies/);
    await page.context().close();
  },
};
