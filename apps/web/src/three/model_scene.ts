// SPDX-License-Identifier: Apache-2.0
// A mesh on the stage: its parts in colors of their own or all in those of a field, displaced, swinging in a mode.

import { BufferAttribute, BufferGeometry, Color, DoubleSide, DynamicDrawUsage, LineBasicMaterial, LineSegments, Mesh, MeshBasicMaterial, MeshLambertMaterial, type Object3D, PlaneGeometry, SRGBColorSpace } from 'three';

import { viridis } from '../lib/palette';
import { extentOf, fieldRange, type SceneData, type SceneFrame, type SceneMesh } from './scene_data';

/** Muted colors of Okabe and Ito for parts, as the report has them. */
export const kPartColors = ['#8fb3d1', '#e2b48f', '#93c9b4', '#dbb3cb', '#ecd49b', '#b5dcf0', '#bdbdbd'];

export const partColor = (k: number) => kPartColors[k % kPartColors.length]!;

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
    if (shown.hasEdges && this.source.edges.length) this.objects.push(this.#edges(ink));
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
    const materials = this.source.parts.map((_, k) => new MeshLambertMaterial(this.range ? { ...side, vertexColors: true } : { ...side, color: partColor(k) }));
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
    const plane = new Mesh(new PlaneGeometry(2.4 * radius, 2.4 * radius), new MeshBasicMaterial({ color: ink, transparent: true, opacity: 0.12, side: DoubleSide, depthWrite: false }));
    plane.position.set(center[0], center[1], this.frame.ground!);
    return plane;
  }
}
