// SPDX-License-Identifier: Apache-2.0
// Forces as arrows at points of a mesh: the longest of each unit has a fixed length, and colors are those of the rods'
// forces. A force that pulls a link starts at the link's end, one that presses on it, or on a wheel, ends there: so no
// arrow lies on its rod. The arrow of a moment has two heads.

import type { Rgb } from '../lib/palette';
import { RodSet } from './rods';
import { longestArrow, type SceneSequence } from './scene_data';
import { cone } from './shapes';
import type { Rods } from './things';
import { length as lengthOf, minus, plus, pointOf, times } from './vectors';

const kLeast = 0.01; // share of the longest; shorter arrows are not drawn
const kPoint = 8; // length of a head in thicknesses of its shaft
const kWide = 0.42; // half the width of a head over its length

export interface ArrowLook {
  length: number; // share of the longest
  thickness: number;
  color: (arrow: number, values: Float32Array | null) => Rgb;
}

export class Arrows {
  #shafts: RodSet;
  #heads: RodSet;
  #second: RodSet;
  #scale: number[];

  constructor(readonly sequence: SceneSequence, readonly look: ArrowLook) {
    const count = sequence.arrows.length;
    this.#shafts = new RodSet(count);
    this.#heads = new RodSet(count, cone(12));
    this.#second = new RodSet(count, cone(12));
    const longest = new Map(sequence.arrows.map(({ unit }) => [unit, longestArrow(sequence, unit)]));
    this.#scale = sequence.arrows.map(({ unit }) => 1 / (longest.get(unit) || 1));
  }

  get things(): Rods[] {
    return [this.#shafts, this.#heads, this.#second].map((part) => part.thing);
  }

  /** Places the arrows at these points of the mesh. */
  place(points: Float32Array, vectors: Float32Array, values: Float32Array | null): void {
    const { length, thickness, color } = this.look;
    this.sequence.arrows.forEach((arrow, k) => {
      const share = times(pointOf(vectors, k), this.#scale[k]!);
      const is = lengthOf(share) > kLeast;
      const along = times(share, is ? length : 0);
      const presses = (values?.[arrow.point] ?? 0) < 0;
      const at = pointOf(points, arrow.point);
      const tail = arrow.is_load || presses ? minus(at, along) : at;
      const head = plus(tail, along);
      const point = Math.min(kPoint * thickness, 0.6 * lengthOf(along));
      const wide = Math.max(kWide * point, 1.2 * thickness);
      const back = times(along, is ? -point / lengthOf(along) : 0);
      const neck = plus(head, back);
      const second = arrow.unit !== 'N' ? plus(neck, back) : neck;
      this.#shafts.place(k, tail, neck, thickness);
      this.#heads.place(k, neck, head, wide);
      this.#second.place(k, second, neck, wide);
      for (const part of [this.#shafts, this.#heads, this.#second]) part.paint(k, color(k, values));
    });
    for (const part of [this.#shafts, this.#heads, this.#second]) part.placed();
  }
}
