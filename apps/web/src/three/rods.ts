// SPDX-License-Identifier: Apache-2.0
// Cylinders or cones between moving points, all in one mesh: rods of a suspension, arrows of forces.

import { type BufferGeometry, Color, CylinderGeometry, InstancedMesh, Matrix4, MeshLambertMaterial, Quaternion, SRGBColorSpace, Vector3 } from 'three';

import type { Rgb } from '../lib/palette';

const kUp = new Vector3(0, 1, 0);

export class Rods {
  readonly mesh: InstancedMesh;
  #along = new Vector3();
  #middle = new Vector3();
  #turn = new Quaternion();
  #place = new Matrix4();
  #color = new Color();

  constructor(count: number, shape: BufferGeometry = new CylinderGeometry(1, 1, 1, 8)) {
    this.mesh = new InstancedMesh(shape, new MeshLambertMaterial(), count);
    this.mesh.frustumCulled = false;
  }

  /** Places rod k from a to b with this thickness; hides it if both points coincide. */
  place(k: number, a: Vector3, b: Vector3, thickness: number): void {
    this.#along.subVectors(b, a);
    const length = this.#along.length();
    const size = length > 1e-6 ? thickness : 0;
    this.#turn.setFromUnitVectors(kUp, length > 1e-6 ? this.#along.divideScalar(length) : kUp);
    this.#middle.addVectors(a, b).multiplyScalar(0.5);
    this.mesh.setMatrixAt(k, this.#place.compose(this.#middle, this.#turn, new Vector3(size, length, size)));
  }

  paint(k: number, [r, g, b]: Rgb): void {
    this.mesh.setColorAt(k, this.#color.setRGB(r / 255, g / 255, b / 255, SRGBColorSpace));
  }

  placed(): void {
    this.mesh.instanceMatrix.needsUpdate = true;
    if (this.mesh.instanceColor) this.mesh.instanceColor.needsUpdate = true;
    this.mesh.boundingSphere = null;
  }
}
