// SPDX-License-Identifier: Apache-2.0
// The axes of a model at a corner of its bounding box: x forward, y to the left, z up (ISO 8855).

import type { SceneMesh } from './scene_data';
import { extentOf } from './scene_data';
import type { Label } from './stage';
import { type Lines, numbers } from './things';
import { bytesOf, linear } from './vectors';

const kLength = 0.22; // share of the radius

/** `isAhead`: at the front right, for a model that is seen from its front left. */
export function triad(mesh: SceneMesh, ink: string, isAhead = false): { lines: Lines; labels: Label[] } {
  const { center, radius, sizes } = extentOf(mesh.points);
  const length = kLength * radius;
  const corner = center.map((middle, axis) => middle + (axis === 0 && isAhead ? 1 : -1) * (sizes[axis]! / 2 + (axis < 2 ? 0.6 * length : 0)));
  const end = (axis: number, reach: number) => corner.map((x, k) => (k === axis ? x + reach * length : x)) as [number, number, number];
  const points = new Float32Array([0, 1, 2].flatMap((axis) => [...corner, ...end(axis, 1)]));
  const lines: Lines = { kind: 'lines', at: [0, 0, 0], center, opacity: 1, points: numbers(points), pairs: null, color: linear(bytesOf(ink)) };
  const labels = ['x', 'y', 'z'].map((text, axis) => ({ text, at: end(axis, 1.25), isStrong: true }));
  return { lines, labels };
}
