// SPDX-License-Identifier: Apache-2.0
// Forces as arrows at points of a mesh: the longest of each unit has a fixed length, and colors are those of the rods'
// forces. A force that pulls a link starts at the link's end, one that presses on it, or on a wheel, ends there: so no
// arrow lies on its rod. The arrow of a moment has two heads.

import { type BufferAttribute, ConeGeometry, type Object3D, Vector3 } from 'three';

import type { Rgb } from '../lib/palette';
import { Rods } from './rods';
import { longestArrow, type SceneSequence } from './scene_data';

const kLeast = 0.01; // share of the longest; shorter arrows are not drawn
const kPoint = 8; // length of a head in thicknesses of its shaft
const kWide = 0.42; // half the width of a head over its length

export interface ArrowLook {
  length: number; // share of the longest
  thickness: number;
  color: (arrow: number, values: Float32Array | null) => Rgb;
}

export class Arrows {
  readonly objects: Object3D[];
  readonly shafts: Rods;
  readonly heads: Rods;
  #second: Rods;
  #scale: number[];

  constructor(readonly sequence: SceneSequence, readonly look: ArrowLook) {
    const count = sequence.arrows.length;
    const cone = () => new ConeGeometry(1, 1, 12);
    this.shafts = new Rods(count);
    this.heads = new Rods(count, cone());
    this.#second = new Rods(count, cone());
    const parts = [this.shafts, this.heads, this.#second];
    this.objects = parts.map((part) => part.mesh);
    const longest = new Map(sequence.arrows.map(({ unit }) => [unit, longestArrow(sequence, unit)]));
    this.#scale = sequence.arrows.map(({ unit }) => 1 / (longest.get(unit) || 1));
  }

  /** Places the arrows at these positions of the mesh. */
  place(positions: BufferAttribute, vectors: Float32Array, values: Float32Array | null): void {
    const [tail, head, neck, along] = [new Vector3(), new Vector3(), new Vector3(), new Vector3()];
    const { length, thickness, color } = this.look;
    this.sequence.arrows.forEach((arrow, k) => {
      along.fromArray(vectors, 3 * k).multiplyScalar(this.#scale[k]!);
      const share = along.length();
      const is = share > kLeast;
      along.multiplyScalar(is ? length : 0);
      tail.fromBufferAttribute(positions, arrow.point);
      const presses = (values?.[arrow.point] ?? 0) < 0;
      if (arrow.is_load || presses) tail.sub(along);
      head.addVectors(tail, along);
      const point = Math.min(kPoint * thickness, 0.6 * along.length());
      const wide = Math.max(kWide * point, 1.2 * thickness);
      neck.copy(head).addScaledVector(along, is ? -point / along.length() : 0);
      const paint = color(k, values);
      this.shafts.place(k, tail, neck, thickness);
      this.heads.place(k, neck, head, wide);
      const isMoment = arrow.unit !== 'N';
      const second = neck.clone().addScaledVector(along, is && isMoment ? -point / along.length() : 0);
      this.#second.place(k, second, isMoment ? neck : second, wide);
      for (const part of [this.shafts, this.heads, this.#second]) part.paint(k, paint);
    });
    for (const part of [this.shafts, this.heads, this.#second]) part.placed();
  }
}
