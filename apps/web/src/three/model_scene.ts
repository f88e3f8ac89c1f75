// SPDX-License-Identifier: Apache-2.0
// A mesh on the stage: its parts in colors of their own or all in those of a field, displaced, swinging in a mode. What
// has edges alone, a suspension, is drawn as rods.

import { BufferAttribute, BufferGeometry, Color, CylinderGeometry, DoubleSide, DynamicDrawUsage, LineBasicMaterial, InstancedMesh, LineSegments, Matrix4, Mesh, MeshBasicMaterial, MeshLambertMaterial, type Object3D, PlaneGeometry, Quaternion, SRGBColorSpace, Vector3 } from 'three';

import { viridis } from '../lib/palette';
import { partColor } from '../lib/part_colors';
import { extentOf, fieldRange, type SceneData, type SceneFrame, type SceneMesh } from './scene_data';

export interface Shown {
  frame: number;
  hidden: ReadonlySet<string>; // parts
  hasField: boolean;
  hasEdges: boolean;
  exaggeration: number; // of displacements, and of a mode
}

export class ModelScene {
  readonly objects: Object3D[] = [];
  readonly mesh: Mesh;
  readonly range: [number, number] | null;
  readonly frame: SceneFrame;
  readonly source: SceneMesh;
  #positions: BufferAttribute;
  #rods: InstancedMesh | null = null;
  #thickness: number;
  #shown: Shown;

  constructor(data: SceneData, shown: Shown, ink: string) {
    this.#shown = shown;
    this.frame = data.frames[shown.frame]!;
    this.source = data.meshes[this.frame.mesh]!;
    this.#positions = new BufferAttribute(new Float32Array(this.source.points.length), 3);
    this.#positions.setUsage(DynamicDrawUsage);
    this.range = this.frame.field && shown.hasField ? fieldRange(this.frame.field.values) : null;
    this.mesh = this.#solid();
    this.objects.push(this.mesh);
    this.#thickness = 0.007 * extentOf(this.source.points).radius;
    if (!this.source.triangles.length) this.objects.push(this.#makeRods());
    else if (shown.hasEdges && this.source.edges.length) this.objects.push(this.#edges(ink));
    if (this.frame.ground !== null) this.objects.push(this.#ground(ink));
    this.place(0);
  }

  /** Points at this sine of a mode's swing; without a mode as the frame has them. */
  place(sine: number): void {
    const { exaggeration } = this.#shown;
    const { points: rest } = this.source;
    const { points, swing } = this.frame;
    const to = this.#positions.array;
    const share = swing ? sine * exaggeration : 0;
    const drawn = swing ? 1 : exaggeration;
    for (let k = 0; k < to.length; ++k) {
      to[k] = rest[k]! + drawn * (points[k]! - rest[k]!) + (swing ? share * swing[k]! : 0);
    }
    this.#positions.needsUpdate = true;
    this.mesh.geometry.boundingSphere = null;
    if (this.#rods) this.#placeRods(this.#rods);
  }

  partOf(triangle: number): string {
    return this.source.parts.find((part) => triangle >= part.first && triangle < part.first + part.count)?.name ?? '';
  }

  #solid(): Mesh {
    const geometry = new BufferGeometry();
    geometry.setAttribute('position', this.#positions);
    geometry.setIndex(new BufferAttribute(this.source.triangles, 1));
    const side = { side: DoubleSide, flatShading: true, polygonOffset: true, polygonOffsetFactor: 1, polygonOffsetUnits: 1 };
    if (this.range) geometry.setAttribute('color', this.#colors(this.range));
    const materials = this.source.parts.map(({ name }) => new MeshLambertMaterial(this.range ? { ...side, vertexColors: true } : { ...side, color: partColor(name) }));
    this.source.parts.forEach((part, k) => {
      if (!this.#shown.hidden.has(part.name)) geometry.addGroup(3 * part.first, 3 * part.count, k);
    });
    const mesh = new Mesh(geometry, materials);
    mesh.frustumCulled = false;
    return mesh;
  }

  #colors([least, greatest]: [number, number]): BufferAttribute {
    const values = this.frame.field!.values;
    const colors = new Float32Array(values.length * 3);
    const color = new Color();
    for (let k = 0; k < values.length; ++k) {
      const [r, g, b] = viridis(greatest > least ? (values[k]! - least) / (greatest - least) : 0.5);
      color.setRGB(r / 255, g / 255, b / 255, SRGBColorSpace).toArray(colors, 3 * k);
    }
    return new BufferAttribute(colors, 3);
  }

  /** What the probe looks for: the solid, or the rods. */
  get body(): Mesh {
    return this.#rods ?? this.mesh;
  }

  /** The nearer end of a rod to a point in space. */
  endOf(rod: number, at: Vector3): number {
    const [a, b] = [this.source.edges[2 * rod]!, this.source.edges[2 * rod + 1]!];
    const distance = (k: number) => at.distanceToSquared(new Vector3().fromBufferAttribute(this.#positions, k));
    return distance(a) < distance(b) ? a : b;
  }

  #makeRods(): InstancedMesh {
    const count = this.source.edges.length / 2;
    this.#rods = new InstancedMesh(new CylinderGeometry(1, 1, 1, 8), new MeshLambertMaterial({ color: partColor(this.source.name) }), count);
    this.#rods.frustumCulled = false;
    return this.#rods;
  }

  #placeRods(rods: InstancedMesh): void {
    const [a, b, along, turn] = [new Vector3(), new Vector3(), new Vector3(), new Quaternion()];
    const up = new Vector3(0, 1, 0);
    for (let k = 0; k < rods.count; ++k) {
      a.fromBufferAttribute(this.#positions, this.source.edges[2 * k]!);
      b.fromBufferAttribute(this.#positions, this.source.edges[2 * k + 1]!);
      along.subVectors(b, a);
      const length = Math.max(along.length(), 1e-6);
      turn.setFromUnitVectors(up, along.divideScalar(length));
      a.add(b).multiplyScalar(0.5);
      rods.setMatrixAt(k, new Matrix4().compose(a, turn, new Vector3(this.#thickness, length, this.#thickness)));
    }
    rods.instanceMatrix.needsUpdate = true;
    rods.boundingSphere = null;
  }

  #edges(ink: string): LineSegments {
    const geometry = new BufferGeometry();
    geometry.setAttribute('position', this.#positions);
    geometry.setIndex(new BufferAttribute(this.source.edges, 1));
    const lines = new LineSegments(geometry, new LineBasicMaterial({ color: ink, transparent: true, opacity: 0.35 }));
    lines.frustumCulled = false;
    return lines;
  }

  #ground(ink: string): Mesh {
    const { center, radius } = extentOf(this.source.points);
    const plane = new Mesh(new PlaneGeometry(2.4 * radius, 2.4 * radius), new MeshBasicMaterial({ color: ink, transparent: true, opacity: 0.12, side: DoubleSide, depthWrite: false, polygonOffset: true, polygonOffsetFactor: 4, polygonOffsetUnits: 4 }));
    plane.position.set(center[0], center[1], this.frame.ground!);
    return plane;
  }
}
