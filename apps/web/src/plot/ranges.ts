// SPDX-License-Identifier: Apache-2.0
// The displayed part of the axes: all marks with a margin, or the selected part.

import type { Value } from '../lib/contract';
import { edges, type Mark } from './marks';

export type Range = [number, number];

export function extent(lists: Iterable<readonly Value[]>, isLog: boolean): Range | null {
  let [least, greatest] = [Infinity, -Infinity];
  for (const list of lists) {
    for (const value of list) {
      if (value === null || !Number.isFinite(value) || (isLog && value <= 0)) continue;
      if (value < least) least = value;
      if (value > greatest) greatest = value;
    }
  }
  return least <= greatest ? [least, greatest] : null;
}

function withAir([least, greatest]: Range, isLog: boolean, share: number): Range {
  if (isLog) {
    const factor = Math.max((greatest / least) ** share, 1.05);
    return [least / factor, greatest * factor];
  }
  const air = greatest > least ? share * (greatest - least) : Math.max(Math.abs(least) * 0.1, 1e-9);
  return [least - air, greatest + air];
}

/** The range of one axis over all marks; for cells their edges, without a margin. */
export function fullRange(marks: readonly Mark[], axis: 'x' | 'y', isLog: boolean, withZero: boolean): Range {
  const grid = marks.find((mark) => mark.kind === 'cells');
  if (grid) {
    const ends = edges(grid[axis], isLog);
    return [ends[0]!, ends.at(-1)!];
  }
  const lists = marks.flatMap((mark) => {
    if (axis === 'x') return [mark.x];
    if (mark.kind === 'edge' || mark.kind === 'vertical') return [];
    return mark.upper ? [mark.y, mark.upper] : [mark.y];
  });
  if (withZero && !isLog && axis === 'y') lists.push([0]);
  const found = extent(lists, isLog);
  if (!found) return isLog ? [0.1, 1] : [0, 1];
  return withAir(found, isLog, axis === 'x' ? 0.015 : 0.06);
}
