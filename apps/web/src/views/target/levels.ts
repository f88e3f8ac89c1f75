// SPDX-License-Identifier: Apache-2.0
// Converts the values of a surface of the target into colors and heights: on a logarithmic scale if they span more than
// a decade.

import type { Surface, Told, Value } from '../../lib/contract';

export interface Levels {
  least: number;
  greatest: number;
  isLog: boolean;
  part: (value: number) => number; // 0 .. 1
}

export function levelsOf(surface: Surface, wantsLog: boolean): Levels {
  const all = surface.target.flat().filter((value): value is number => value !== null && Number.isFinite(value));
  const least = Math.min(...all);
  const greatest = Math.max(...all);
  const isLog = wantsLog && least > 0;
  const span = isLog ? Math.log(greatest / least) : greatest - least;
  const part = (value: number) => (span > 0 ? (isLog ? Math.log(value / least) : value - least) / span : 0.5);
  return { least, greatest, isLog, part };
}

export function spansDecade(surface: Surface): boolean {
  const { least, greatest } = levelsOf(surface, false);
  return least > 0 && greatest > 10 * least;
}

/** Positions of the design's minima on a surface: their values of the two variables. */
export function placesOf(surface: Surface, variables: readonly string[], rows: readonly { values: Told[] }[]): [Value, Value][] {
  const [i, j] = [variables.indexOf(surface.x.name), variables.indexOf(surface.y.name)];
  if (i < 0 || j < 0) return [];
  return rows.map((row) => [numberIn(row.values[i]), numberIn(row.values[j])]);
}

/** Returns 22.3 for 22.3 and for "22.3 N/mm^2". */
function numberIn(told: Told | undefined): Value {
  if (typeof told === 'number') return told;
  const value = typeof told === 'string' ? Number.parseFloat(told) : NaN;
  return Number.isFinite(value) ? value : null;
}
