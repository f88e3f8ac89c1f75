// SPDX-License-Identifier: Apache-2.0
// Ticks of a logarithmic axis between two decimal logarithms, as decimal logarithms: decades, with 2 and 5 between them
// where few decades are seen, finer ones where less than one is.

const kMost = 8;

export function logTicks(least: number, greatest: number): number[] {
  const decades = greatest - least;
  const steps = decades > kMost ? [1] : decades > 2.5 ? [1, 3] : decades > 0.9 ? [1, 2, 5] : [1, 1.5, 2, 3, 4, 5, 6, 7, 8, 9];
  const every = decades > kMost ? Math.ceil(decades / kMost) : 1;
  const ticks: number[] = [];
  for (let decade = Math.floor(least); decade <= greatest; decade += every) {
    for (const step of steps) {
      const tick = decade + Math.log10(step);
      if (tick >= least - 1e-9 && tick <= greatest + 1e-9) ticks.push(tick);
    }
  }
  return ticks.length >= 2 ? ticks : evenTicks(least, greatest);
}

/** Round numbers evenly spaced, for a stretch so short that it is nearly linear. */
function evenTicks(least: number, greatest: number): number[] {
  const [from, to] = [10 ** least, 10 ** greatest];
  const size = 10 ** Math.floor(Math.log10((to - from) / 3));
  const step = size * [1, 2, 5].filter((factor) => factor * size <= (to - from) / 3).at(-1)!;
  const ticks: number[] = [];
  for (let k = Math.ceil(from / step); k * step <= to; ++k) ticks.push(Math.log10(k * step));
  return ticks;
}
