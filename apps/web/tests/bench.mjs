// SPDX-License-Identifier: Apache-2.0
// Measures the page on the real program: node tests/bench.mjs LATSCH FOLDER, where FOLDER holds the studies
//   many/study.toml   with a journal of 50 000 trials
//   some/study.toml   with a journal of 5 000 trials and its report, some/study.html
//   live/study.toml   that was never run, and whose trials take some tenths of a second
// With --smoke behind them the existing journals are used whatever their length, few views are measured and no tire is
// fitted. Prints one line for each figure: its name, a tab, the number. A failure ends the program.

import { execFileSync, spawn } from 'node:child_process';
import { statSync } from 'node:fs';
import { join, resolve } from 'node:path';

import { newPage, openBrowser, settled, violations } from './browser.mjs';
import { loadTime, redrawTime } from './load.mjs';

const [latsch, folder] = process.argv.slice(2, 4).map((path) => resolve(path));
const smoke = process.argv[4] === '--smoke';
const tell = (name, value) => console.log(`${name}\t${value}`);
const pause = (ms) => new Promise((done) => setTimeout(done, ms));

/** Starts the program; resolves when it has printed its address. */
function serve(...words) {
  const child = spawn(latsch, words, { stdio: ['ignore', 'pipe', 'inherit'] });
  process.on('exit', () => child.kill('SIGINT'));
  const address = new Promise((found, failed) => {
    let text = '';
    child.stdout.on('data', (part) => {
      text += part;
      const match = /http:\/\/\S+token=\S+/.exec(text);
      if (match) found(match[0]);
    });
    child.on('exit', () => failed(new Error(`latsch ${words.join(' ')} ended without an address`)));
  });
  return { address, end: () => new Promise((ended) => { child.removeAllListeners('exit'); child.on('exit', ended); child.kill('SIGINT'); }) };
}

/** Requests data of the server as a script does. */
function asking(address) {
  const { origin, searchParams } = new URL(address);
  const headers = { Authorization: `Bearer ${searchParams.get('token')}`, 'Content-Type': 'application/json' };
  return async (path, body) => {
    const answer = await fetch(origin + path, body ? { method: 'POST', headers, body: JSON.stringify(body) } : { headers });
    if (!answer.ok) throw new Error(`${path}: ${answer.status} ${await answer.text()}`);
    return answer.json();
  };
}

async function until(holds, seconds = 120) {
  for (const end = Date.now() + 1000 * seconds; Date.now() < end; await pause(5)) {
    const value = await holds();
    if (value) return value;
  }
  throw new Error(`it did not come in ${seconds} s: ${holds}`);
}

/** Time of the last write to the journal, ms; 0 if there is none. */
function written(study) {
  const time = (file) => statSync(file, { throwIfNoEntry: false })?.mtimeMs ?? 0;
  const journal = join(folder, study.replace('.toml', '.latsch'));
  return Math.max(time(journal), time(`${journal}-wal`));
}

/** Milliseconds from the commit of a trial to its number on the page, the longest of several. */
async function livePoints(page, ask, study) {
  await page.goto(`${origin}/#/convergence?study=${study}`);
  await settled(page);
  await ask('/api/run', { study, verb: 'run', workers: 1 });
  let longest = 0;
  for (let trial = 1; trial <= 5; ++trial) {
    const shown = page.waitForFunction(
      (k) => [...document.querySelectorAll('body *')].some((e) => !e.children.length && new RegExp(`(^|\\D)${k} trials?\\b`).test(e.textContent)), trial, { polling: 10, timeout: 60000 });
    let last = written(study);
    const count = async () => (await ask(`/api/study?study=${study}`)).trials;
    const committed = (async () => {
      // The write-ahead log grows with every commit; its last growth before the count changes is that of the trial.
      while ((await count()) < trial) { last = written(study); await pause(2); }
      return Math.max(last, written(study));
    })();
    await shown;
    const at = Date.now();
    longest = Math.max(longest, at - (await committed));
  }
  return longest;
}

const views = smoke ? ['convergence', 'comparison']
  : ['study', 'setup', 'model', 'convergence', 'target', 'comparison', 'kpis', 'identifiability'];

/** Violations found by axe and errors of the console in every view of a study. */
async function faults(browser, address, studies) {
  const found = { axe: 0, console: 0 };
  for (const scheme of smoke ? ['dark'] : ['light', 'dark']) {
    const page = await newPage(browser, { scheme });
    await page.goto(address);
    const look = async (hash) => {
      await page.goto(`${origin}/${hash}`);
      await settled(page).catch((error) => { throw new Error(`${hash}: ${error.message}`); });
      const words = await violations(page);
      for (const one of words) console.error(`${scheme} ${hash}: ${one}`);
      found.axe += words.length;
    };
    await look('#/home');
    for (const study of studies) for (const view of views) await look(`#/${view}?study=${study}`);
    await look(`#/compare?study=${studies[0]}&other=${studies[1]}`);
    for (const error of page.errors) console.error(`${scheme}: ${error}`);
    found.console += page.errors.length;
    await page.context().close();
  }
  return found;
}

const browser = await openBrowser();
const server = serve('serve', folder, '--no-browser');
const address = await server.address;
const { origin } = new URL(address);
const ask = asking(address);

const began = Date.now();
await until(async () => (await ask('/api/study?study=many/study.toml')).read >= (smoke ? 100 : 50000));
tell('many_read_s', (Date.now() - began) / 1000);
tell('many_load_ms', await loadTime(browser, address, 'many/study.toml'));
tell('many_redraw_ms', await redrawTime(browser, address, 'many/study.toml'));

if (!smoke) {
  const fresh = Date.now(); // timed like an installation: a tire, its study, the run, the first point
  execFileSync(latsch, ['new', join(folder, 'fresh')], { stdio: 'ignore' });
  await until(async () => (await ask('/api/home')).studies.some((one) => one.study === 'fresh/study.toml' && one.state === 'new'));
  await ask('/api/run', { study: 'fresh/study.toml', verb: 'run', workers: 2 });
  await until(async () => (await ask('/api/convergence?study=fresh/study.toml')).total > 0);
  tell('fresh_s', (Date.now() - fresh) / 1000);
  await ask('/api/stop', { study: 'fresh/study.toml' });
  await until(async () => (await ask('/api/study?study=fresh/study.toml')).state !== 'running');
}

const page = await newPage(browser);
await page.goto(address);
tell('live_ms', await livePoints(page, ask, 'live/study.toml'));
const stopped = Date.now();
await ask('/api/stop', { study: 'live/study.toml' });
await until(async () => (await ask('/api/study?study=live/study.toml')).state !== 'running');
tell('stop_ms', Date.now() - stopped);
await page.context().close();

const { axe, console: errors } = await faults(browser, address, ['live/study.toml', 'some/study.toml']);
tell('axe', axe);
tell('console', errors);
await server.end();

const report = await newPage(browser);
const opened = Date.now();
await report.goto(`file://${join(folder, 'some', 'study.html')}`);
await settled(report);
tell('report_open_ms', Date.now() - opened);
tell('report_bytes', statSync(join(folder, 'some', 'study.html')).size);
tell('report_faults', (await violations(report)).length + report.errors.length);
await browser.close();
