// SPDX-License-Identifier: Apache-2.0
// Writes the files of a folder, gzipped, as a C++ source that includes their bytes: node tools/embed.mjs DIST
// web_assets.cpp

import { createHash } from 'node:crypto';
import { mkdirSync, readdirSync, readFileSync, rmSync, statSync, writeFileSync } from 'node:fs';
import { basename, extname, join, relative, sep } from 'node:path';
import { gzipSync } from 'node:zlib';

const kTypes = {
  '.html': 'text/html; charset=utf-8',
  '.js': 'text/javascript; charset=utf-8',
  '.css': 'text/css; charset=utf-8',
  '.svg': 'image/svg+xml',
};

const [folder, output] = process.argv.slice(2);
const packed = `${output}.gz`;
rmSync(packed, { recursive: true, force: true });
mkdirSync(packed, { recursive: true });

const filesOf = (at) => readdirSync(at).sort().flatMap((name) => (statSync(join(at, name)).isDirectory() ? filesOf(join(at, name)) : [join(at, name)]));

const assets = filesOf(folder).map((file, k) => {
  const type = kTypes[extname(file)];
  if (!type) throw new Error(`embed.mjs: ${file}: of what type is it? Name it in kTypes.`);
  const bytes = gzipSync(readFileSync(file), { level: 9 });
  const etag = createHash('sha256').update(bytes).digest('hex').slice(0, 16);
  const stored = join(packed, `${etag}_${basename(file)}.gz`); // the name depends on the bytes, so that this source
                                                               // changes with them
  writeFileSync(stored, bytes);
  return { symbol: `latsch_web_asset_${k}`, path: `/${relative(folder, file).split(sep).join('/')}`, type, etag, stored };
});

const bytesOf = ({ symbol, stored }) => `
asm(".pushsection .rodata\\n.balign 16\\n"
    ".globl ${symbol}\\n${symbol}:\\n.incbin \\"${stored}\\"\\n"
    ".globl ${symbol}_end\\n${symbol}_end:\\n.byte 0\\n.popsection\\n");
extern "C" const char ${symbol}[], ${symbol}_end[];
`;
const entryOf = ({ symbol, path, type, etag }) =>
  `      {"${path}",\n       "${type}",\n       {${symbol}, static_cast<std::size_t>(${symbol}_end - ${symbol})},\n       true,\n       "\\"${etag}\\""},\n`;

writeFileSync(output, `// Made by apps/web/tools/embed.mjs.
#include "web/web_assets.h"
${assets.map(bytesOf).join('')}
std::vector<latsch::studio::Asset> latsch::studio::web_assets() {
  return {
${assets.map(entryOf).join('')}  };
}
`);
