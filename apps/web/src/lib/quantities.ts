// SPDX-License-Identifier: Apache-2.0
// Quantities as in a study file: a text with its unit, or a plain number if there is no unit.

export function inFile(value: number, unit: string): string | number {
  return unit && unit !== '1' ? `${value} ${unit}` : value;
}

/** The written value of a key in a table of a TOML text; "" if it is not set. For tables with a head of their own. */
export function written(text: string, table: string, key: string): string {
  let isThere = false;
  for (const line of text.split('\n')) {
    const head = /^\s*\[([^\]]+)\]/.exec(line);
    if (head) isThere = head[1]!.trim() === table;
    else if (isThere) {
      const entry = /^\s*([A-Za-z0-9_-]+)\s*=\s*("(?:[^"\\]|\\.)*"|[^#]*)/.exec(line);
      if (entry?.[1] === key) return entry[2]!.trim().replace(/^"(.*)"$/, '$1');
    }
  }
  return '';
}
