// SPDX-License-Identifier: Apache-2.0
// Cylinders or cones between moving points, all drawn at once: rods of a suspension, arrows of forces.

import type { Rgb } from '../lib/palette';
import { cylinder } from './shapes';
import { numbers, type Rods, type Shape } from './things';
import { linear, type Vector } from './vectors';

export class RodSet {
  readonly thing: Rods;

  constructor(count: number, shape: Shape = cylinder(8)) {
    const [ends, colors] = [numbers(new Float32Array(7 * count)), numbers(new Float32Array(3 * count))];
    this.thing = { kind: 'rods', at: [0, 0, 0], center: [0, 0, 0], opacity: 1, shape, ends, colors };
  }

  /** Places rod k from a to b with this radius; hides it if both points coincide. */
  place(k: number, a: Vector, b: Vector, radius: number): void {
    this.thing.ends.data.set([...a, ...b, radius], 7 * k);
  }

  paint(k: number, color: Rgb): void {
    this.thing.colors.data.set(linear(color), 3 * k);
  }

  placed(): void {
    ++this.thing.ends.version;
    ++this.thing.colors.version;
  }
}
