// SPDX-License-Identifier: Apache-2.0
// The target over two variables as a surface in a box of 2 x 2 x 1: height and color show the target on its scale.

import type { Surface, SurfaceAxis, Value } from '../lib/contract';
import { named, number } from '../lib/numbers';
import { viridis } from '../lib/palette';
import type { Levels } from '../views/target/levels';
import { ball as ballOf } from './shapes';
import type { Label } from './stage';
import { type Lines, numbers, type Solid } from './things';
import { bytesOf, cross, linear, minus, plus, pointOf, unit, type Vector } from './vectors';

type Place = [number, number, number];

const kMiddle: Vector = [0, 0, 0.5]; // the middle of the box

function along(axis: SurfaceAxis, value: number): number {
  const way = axis.scale === 'logarithmic' ? Math.log : (x: number) => x;
  const [least, greatest] = [way(axis.levels[0]!), way(axis.levels.at(-1)!)];
  return greatest === least ? 0 : (2 * (way(value) - least)) / (greatest - least) - 1;
}

const edgePairs = (nx: number, ny: number) => {
  const pairs: number[] = [];
  for (let i = 0; i < nx; ++i) {
    for (let j = 0; j < ny; ++j) {
      if (i + 1 < nx) pairs.push(i * ny + j, (i + 1) * ny + j);
      if (j + 1 < ny) pairs.push(i * ny + j, i * ny + j + 1);
    }
  }
  return pairs;
};

export function surfaceMesh(surface: Surface, levels: Levels, ink: string): { mesh: Solid; grid: Lines } {
  const [nx, ny] = [surface.x.levels.length, surface.y.levels.length];
  const places = new Float32Array(nx * ny * 3);
  const colors = new Float32Array(nx * ny * 3);
  const isKnown = (k: number) => Number.isFinite(surface.target[Math.floor(k / ny)]?.[k % ny] ?? NaN);
  for (let k = 0; k < nx * ny; ++k) {
    const [i, j] = [Math.floor(k / ny), k % ny];
    const part = isKnown(k) ? levels.part(surface.target[i]![j]!) : 0;
    places.set([along(surface.x, surface.x.levels[i]!), along(surface.y, surface.y.levels[j]!), part], 3 * k);
    colors.set(linear(viridis(part)), 3 * k);
  }
  const triangles: number[] = [];
  for (let i = 0; i + 1 < nx; ++i) {
    for (let j = 0; j + 1 < ny; ++j) {
      const [a, b, c, d] = [i * ny + j, (i + 1) * ny + j, (i + 1) * ny + j + 1, i * ny + j + 1];
      if ([a, b, c, d].every(isKnown)) triangles.push(a, b, c, a, c, d);
    }
  }
  const points = numbers(places);
  const drawn = new Uint32Array(triangles);
  const mesh: Solid = {
    kind: 'solid', at: [0, 0, 0], center: kMiddle, opacity: 1, points, triangles: drawn, normals: numbers(normalsOf(places, drawn)), colors: numbers(colors),
    parts: [{ first: 0, count: drawn.length, color: [0, 0, 0] }], hasBack: true, isLit: true, behind: 1, isVeil: false,
  };
  const pairs = edgePairs(nx, ny).filter((_, k, all) => isKnown(all[k - (k % 2)]!) && isKnown(all[k - (k % 2) + 1]!));
  return { mesh, grid: { kind: 'lines', at: [0, 0, 0], center: kMiddle, opacity: 0.35, points, pairs: new Uint32Array(pairs), color: linear(bytesOf(ink)) } };
}

/** Normals of the points: the mean of their triangles' normals, weighted by area. */
function normalsOf(places: Float32Array, triangles: Uint32Array): Float32Array {
  const sums = new Float32Array(places.length);
  for (let at = 0; at < triangles.length; at += 3) {
    const corners = triangles.subarray(at, at + 3);
    const [a, b, c] = Array.from(corners, (k) => pointOf(places, k)) as [Vector, Vector, Vector];
    const normal = cross(minus(b, a), minus(c, a));
    for (const k of corners) sums.set(plus(pointOf(sums, k), normal), 3 * k);
  }
  for (let k = 0; 3 * k < sums.length; ++k) {
    const sum = pointOf(sums, k);
    if (sum.some((x) => x !== 0)) sums.set(unit(sum), 3 * k);
  }
  return sums;
}

/** The frame below the surface and around it. */
export function box(ink: string): Lines {
  const corners = [[-1, -1], [1, -1], [1, 1], [-1, 1]] as const;
  const places = corners.flatMap(([x, y], k) => {
    const [nextX, nextY] = corners[(k + 1) % 4]!;
    return [x, y, 0, nextX, nextY, 0, x, y, 0, x, y, 1];
  });
  return { kind: 'lines', at: [0, 0, 0], center: kMiddle, opacity: 0.4, points: numbers(new Float32Array(places)), pairs: null, color: linear(bytesOf(ink)) };
}

export function labels(surface: Surface, levels: Levels): Label[] {
  const ticks = (axis: SurfaceAxis, at: (part: number) => Place): Label[] => {
    const count = axis.levels.length;
    const shown = count <= 5 ? axis.levels : [0, 0.25, 0.5, 0.75, 1].map((part) => axis.levels[Math.round(part * (count - 1))]!);
    return shown.map((level) => ({ text: number(level, 3), at: at(along(axis, level)) }));
  };
  return [
    ...ticks(surface.x, (x) => [x, -1.13, 0]),
    ...ticks(surface.y, (y) => [1.13, y, 0]),
    { text: named(surface.x.name, surface.x.unit), at: [0, -1.52, 0], isStrong: true },
    { text: named(surface.y.name, surface.y.unit), at: [1.52, 0, 0], isStrong: true },
    { text: `${number(levels.least * 100, 3)} %`, at: [-1.24, -1, 0.05] },
    { text: `${number(levels.greatest * 100, 3)} %`, at: [-1.24, -1, 1] },
  ];
}

/** Position of a point of the variables on the surface: above the nearest point of the grid. */
export function placeOn(surface: Surface, levels: Levels, [x, y]: [Value, Value]): Place | null {
  if (x === null || y === null) return null;
  const closest = (axis: SurfaceAxis, value: number) => axis.levels.reduce((best, level, k) => (Math.abs(along(axis, level) - along(axis, value)) < Math.abs(along(axis, axis.levels[best]!) - along(axis, value)) ? k : best), 0);
  const value = surface.target[closest(surface.x, x)]?.[closest(surface.y, y)];
  return value === null || value === undefined ? null : [along(surface.x, x), along(surface.y, y), levels.part(value)];
}

export function ball(at: Place, color: string, radius: number): Solid {
  const { points, normals, triangles } = ballOf(radius, 20, 14);
  return {
    kind: 'solid', at, center: [0, 0, 0], opacity: 1, points: numbers(points), normals: numbers(normals), colors: null, triangles,
    parts: [{ first: 0, count: triangles.length, color: linear(bytesOf(color)) }], hasBack: false, isLit: true, behind: 0, isVeil: false,
  };
}
