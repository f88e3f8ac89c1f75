// SPDX-License-Identifier: Apache-2.0
// Counts of values in cells of equal width, for a mark of steps.

import type { Value } from '../../lib/contract';

const kCells = 24;

/** Edges of the cells and the count that begins at each; the last edge has count 0. Values that are not numbers, or not
 * positive on a logarithmic scale, are left out. */
export function histogram(values: readonly Value[], isLog: boolean): { x: number[]; y: number[] } {
  const way = isLog ? Math.log : (value: number) => value;
  const at = values.map((value) => (value === null ? NaN : way(value))).filter(Number.isFinite);
  if (at.length === 0) return { x: [], y: [] };
  const [least, greatest] = [Math.min(...at), Math.max(...at)];
  const width = greatest > least ? (greatest - least) / kCells : 1;
  const counts = new Array<number>(kCells).fill(0);
  for (const value of at) counts[Math.min(Math.floor((value - least) / width), kCells - 1)]! += 1;
  const edge = (k: number) => (isLog ? Math.exp(least + k * width) : least + k * width);
  return { x: Array.from({ length: kCells + 1 }, (_, k) => edge(k)), y: [...counts, 0] };
}
