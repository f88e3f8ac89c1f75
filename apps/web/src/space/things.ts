// SPDX-License-Identifier: Apache-2.0
// Things that can be drawn in space, as data: solids of triangles, lines, and rods. Colors are linear (vectors.ts).

import type { Vector } from './vectors';

/** Numbers in the memory of the graphics processor, which gets them again if the version is another one. */
export interface Numbers {
  data: Float32Array;
  version: number;
}

export const numbers = (data: Float32Array): Numbers => ({ data, version: 0 });

interface Thing {
  at: Vector; // is added to all points
  center: Vector; // the middle of its points: things that let light through are drawn from the farthest to the nearest
  opacity: number;
}

export interface Solid extends Thing {
  kind: 'solid';
  points: Numbers;
  triangles: Uint32Array;
  normals: Numbers | null; // null: each triangle is flat
  colors: Numbers | null; // one a point; null: the parts have their own
  parts: { first: number; count: number; color: Vector }[]; // ranges of `triangles`, in indices
  hasBack: boolean; // true: triangles are seen from both sides
  isLit: boolean; // false: light does not change colors
  behind: number; // steps of depth by which it is moved away from the eye, so that lines on it are seen
  isVeil: boolean; // true: it does not cover what is drawn later
}

export interface Lines extends Thing {
  kind: 'lines';
  points: Numbers;
  pairs: Uint32Array | null; // points that are joined; null: first and second, third and fourth ...
  color: Vector;
}

/** A shape between pairs of points: its axis is y from -0.5 to 0.5, its radius 1. */
export interface Shape {
  points: Float32Array;
  normals: Float32Array;
  triangles: Uint32Array;
}

export interface Rods extends Thing {
  kind: 'rods';
  shape: Shape;
  ends: Numbers; // seven a rod: both ends and the radius, 0 for none
  colors: Numbers; // three a rod
}

export type Drawn = Solid | Lines | Rods;
