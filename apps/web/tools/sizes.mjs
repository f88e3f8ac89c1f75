// SPDX-License-Identifier: Apache-2.0
// Prints the gzipped size of the page, and fails if it exceeds the limits: a first script of 60 KB without what is
// loaded later, 200 KB of scripts in all.

import { readdirSync, readFileSync } from 'node:fs';
import { join } from 'node:path';
import { gzipSync } from 'node:zlib';

const kFirst = 60e3;
const kAll = 200e3;

const folder = process.env.LATSCH_WEB_OUT ?? 'dist';
const size = (file) => gzipSync(readFileSync(file), { level: 9 }).length;
const kilobytes = (bytes) => `${(bytes / 1000).toFixed(1)} KB`;

const assets = readdirSync(join(folder, 'assets')).map((name) => ({ name, bytes: size(join(folder, 'assets', name)) }));
const scripts = assets.filter(({ name }) => name.endsWith('.js'));
const page = readFileSync(join(folder, 'index.html'), 'utf8');
const first = scripts.filter(({ name }) => page.includes(name)).reduce((sum, { bytes }) => sum + bytes, 0);
const all = scripts.reduce((sum, { bytes }) => sum + bytes, 0);

for (const { name, bytes } of assets.sort((a, b) => b.bytes - a.bytes)) console.log(`  ${kilobytes(bytes).padStart(9)}  ${name}`);
console.log(`first script ${kilobytes(first)} gzipped (at most ${kilobytes(kFirst)}), scripts in all ${kilobytes(all)} (at most ${kilobytes(kAll)})`);
console.log(`report.js ${kilobytes(size(join(folder, 'report', 'report.js')))}, report.css ${kilobytes(size(join(folder, 'report', 'report.css')))} gzipped`);
if (first > kFirst || all > kAll) {
  console.error('sizes.mjs: the page weighs more than it may');
  process.exit(1);
}
