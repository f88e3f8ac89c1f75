// SPDX-License-Identifier: Apache-2.0
// Ticks of a logarithmic axis between two decimal logarithms, as decimal logarithms: decades and round numbers between
// them, as many as fit; evenly spaced ticks if the range is so short that it is nearly linear.

const kSteps = [[1, 1.5, 2, 3, 4, 5, 6, 7, 8, 9], [1, 1.5, 2, 3, 4, 5, 7], [1, 2, 3, 5, 7], [1, 2, 5], [1, 3], [1]];
const kLeast = 3;

export function logTicks(least: number, greatest: number, most: number): number[] {
  const sets = kSteps.map((steps) => ticksAt(steps, 1, least, greatest));
  const fitting = sets.find((ticks) => ticks.length <= most);
  if (fitting) return fitting.length >= kLeast ? fitting : evenTicks(least, greatest, most);
  return ticksAt([1], Math.ceil((greatest - least) / most), least, greatest);
}

function ticksAt(steps: readonly number[], every: number, least: number, greatest: number): number[] {
  const ticks: number[] = [];
  for (let decade = Math.floor(least); decade <= greatest; ++decade) {
    if (decade % every !== 0) continue;
    for (const step of steps) {
      const tick = decade + Math.log10(step);
      if (tick >= least - 1e-9 && tick <= greatest + 1e-9) ticks.push(tick);
    }
  }
  return ticks;
}

function evenTicks(least: number, greatest: number, most: number): number[] {
  const [from, to] = [10 ** least, 10 ** greatest];
  const rough = (to - from) / Math.max(most, 1);
  const size = 10 ** Math.floor(Math.log10(rough));
  const step = size * [1, 2, 5, 10].find((factor) => factor * size >= rough)!;
  const ticks: number[] = [];
  for (let k = Math.ceil(from / step); k * step <= to; ++k) ticks.push(Math.log10(k * step));
  return ticks;
}
