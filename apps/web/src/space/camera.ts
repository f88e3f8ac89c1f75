// SPDX-License-Identifier: Apache-2.0
// A camera with perspective that looks at a point, z up. Its frame has x to the right, y up, and z towards the viewer.

import { cross, dot, minus, plus, times, unit, type Vector } from './vectors';

const kHalfAngle = (16 * Math.PI) / 180; // half the angle of view from the lower to the upper edge

export interface Ray {
  from: Vector;
  along: Vector; // a direction of length 1
}

export class Camera {
  aspect = 1; // width over height of the picture
  eye: Vector = [0, 0, 1];
  right: Vector = [1, 0, 0];
  up: Vector = [0, 1, 0];
  back: Vector = [0, 0, 1];
  #near = 0.01;
  #far = 100;

  readonly sine = Math.sin(kHalfAngle);
  readonly tangent = Math.tan(kHalfAngle);

  /** Draws what is between these distances from the eye. */
  setReach(near: number, far: number): void {
    this.#near = near;
    this.#far = far;
  }

  look(eye: Vector, target: Vector): void {
    this.eye = eye;
    this.back = unit(minus(eye, target));
    this.right = unit(cross([0, 0, 1], this.back));
    this.up = cross(this.back, this.right);
  }

  /** Turns points of the scene into points of the camera's frame. */
  get view(): Float32Array {
    const rows = [this.right, this.up, this.back];
    return new Float32Array([0, 1, 2].flatMap((axis) => [...rows.map((row) => row[axis]!), 0]).concat(rows.map((row) => -dot(row, this.eye)), 1));
  }

  /** Turns points of the camera's frame into those of the picture. */
  get projection(): Float32Array {
    const [near, far, scale] = [this.#near, this.#far, 1 / this.tangent];
    return new Float32Array([scale / this.aspect, 0, 0, 0, 0, scale, 0, 0, 0, 0, (near + far) / (near - far), -1, 0, 0, (2 * near * far) / (near - far), 0]);
  }

  /** Distance of a point in front of the eye; negative behind it. */
  depth(point: Vector): number {
    return dot(this.back, minus(this.eye, point));
  }

  /** Where a point is in the picture: -1 to 1 from left to right and from below upwards; null unless it is in reach. */
  project(point: Vector): [number, number] | null {
    const depth = this.depth(point);
    if (depth < this.#near || depth > this.#far) return null;
    const from = minus(point, this.eye);
    return [dot(this.right, from) / (depth * this.tangent * this.aspect), dot(this.up, from) / (depth * this.tangent)];
  }

  /** The ray of all points that are at this place of the picture. */
  ray(x: number, y: number): Ray {
    const sideways = plus(times(this.right, x * this.tangent * this.aspect), this.up, y * this.tangent);
    return { from: this.eye, along: unit(minus(sideways, this.back)) };
  }
}
