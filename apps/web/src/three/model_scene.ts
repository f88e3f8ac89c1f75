// SPDX-License-Identifier: Apache-2.0
// A mesh on the stage: its parts in colors of their own or all in those of a field, displaced or vibrating in a mode;
// its rods (links of a suspension) in the colors of their forces; a step of a test, with arrows and the road below.

import { BufferAttribute, BufferGeometry, Color, DoubleSide, DynamicDrawUsage, LineBasicMaterial, LineSegments, Mesh, MeshBasicMaterial, MeshLambertMaterial, type Object3D, PlaneGeometry, SRGBColorSpace, Vector3 } from 'three';

import { diverging, kForceless, type Rgb, viridis } from '../lib/palette';
import { partColor } from '../lib/part_colors';
import { Arrows } from './arrows';
import { Rods } from './rods';
import { extentOf, fieldRange, type SceneData, type SceneFrame, type SceneMesh, type SceneSequence, signedRange, stepOf } from './scene_data';

export interface Shown {
  what: SceneFrame | SceneSequence;
  hidden: ReadonlySet<string>; // names of parts
  hasField: boolean;
  hasEdges: boolean;
  hasForces: boolean;
  exaggeration: number; // factor of displacements and modes
  arrows: number; // length of arrows
  ink: string;
  load: Rgb; // color of external forces
}

export const isSequence = (what: SceneFrame | SceneSequence): what is SceneSequence => 'at' in what;

const kArrow = 0.42; // share of the radius; length of the longest arrow
const kCrest = '#5e6a76'; // color of a road
const kGlass = 0.28; // opacity of parts around the links

/** The object below the pointer: a rod or an arrow by its number, else the nearest point. */
export interface Found {
  point: number;
  rod: string | null;
  arrow: number | null;
}

export class ModelScene {
  readonly objects: Object3D[] = [];
  readonly mesh: Mesh;
  readonly source: SceneMesh;
  readonly range: [number, number] | null;
  points: Float32Array; // points of the displayed step or frame
  values: Float32Array | null;
  #positions: BufferAttribute;
  #rods: Rods | null = null;
  #ends: number[] = []; // points of the rods, two each
  #names: string[] = []; // names of the rods
  #arrows: Arrows | null = null;
  #road: Mesh | null = null;
  #thickness: number;

  constructor(
    data: SceneData,
    readonly shown: Shown,
  ) {
    const { what } = shown;
    this.source = data.meshes[what.mesh]!;
    const first = isSequence(what) ? stepOf(what, 0) : { points: what.points, values: what.field?.values ?? null };
    this.points = first.points;
    this.values = first.values;
    this.#positions = new BufferAttribute(new Float32Array(this.source.points.length), 3);
    this.#positions.setUsage(DynamicDrawUsage);
    this.range = what.field && shown.hasField ? (isSequence(what) ? signedRange : fieldRange)(what.field.values) : null;
    this.mesh = this.#solid();
    this.objects.push(this.mesh);
    const { radius } = extentOf(this.source.points);
    this.#thickness = 0.007 * radius;
    if (this.source.rods.length) this.#makeRods();
    if (shown.hasEdges) this.#edges();
    if (isSequence(what)) {
      if (shown.hasForces && what.arrows.length) this.#makeArrows(what, radius);
      if (what.ground !== null) this.#makeRoad(data.meshes[what.ground]!);
      this.show(0);
    } else {
      if (what.ground !== null) this.objects.push(this.#level(what.ground));
      this.place(0);
    }
  }

  /** Shows a step of the sequence. */
  show(step: number): void {
    const { what } = this.shown;
    if (!isSequence(what)) return;
    const now = stepOf(what, step);
    this.points = now.points;
    this.values = now.values;
    this.place(0);
    this.#arrows?.place(this.#positions, now.vectors, now.values);
    this.#road?.position.setX(-what.origins[step]!);
  }

  /** Places points at this sine of a mode's oscillation; without a mode at their positions in the frame. */
  place(sine: number): void {
    const { what, exaggeration } = this.shown;
    const rest = this.source.points;
    const swing = isSequence(what) ? null : what.swing;
    const to = this.#positions.array;
    const share = swing ? sine * exaggeration : 0;
    const drawn = swing ? 1 : exaggeration;
    for (let k = 0; k < to.length; ++k) {
      to[k] = rest[k]! + drawn * (this.points[k]! - rest[k]!) + (swing ? share * swing[k]! : 0);
    }
    this.#positions.needsUpdate = true;
    this.mesh.geometry.boundingSphere = null;
    this.#placeRods();
  }

  /** Meshes that the probe searches. */
  get bodies(): Mesh[] {
    const solid = this.source.triangles.length ? [this.mesh] : [];
    return [...(this.#arrows ? [this.#arrows.shafts.mesh, this.#arrows.heads.mesh] : []), ...(this.#rods ? [this.#rods.mesh] : []), ...solid];
  }

  found(object: Object3D, instance: number | undefined, nearest: number, at: Vector3): Found {
    const arrows = this.#arrows;
    if (instance !== undefined && arrows && (object === arrows.shafts.mesh || object === arrows.heads.mesh)) {
      return { point: arrows.sequence.arrows[instance]!.point, rod: null, arrow: instance };
    }
    if (instance === undefined || object !== this.#rods?.mesh) return { point: nearest, rod: null, arrow: null };
    const [a, b] = [this.#ends[2 * instance]!, this.#ends[2 * instance + 1]!];
    const distance = (k: number) => at.distanceToSquared(new Vector3().fromBufferAttribute(this.#positions, k));
    return { point: distance(a) < distance(b) ? a : b, rod: this.#names[instance]!, arrow: null };
  }

  /** The color of a force; without a value that of no force. */
  #force(value: number | undefined): Rgb {
    const most = this.range?.[1] ?? 0;
    return value === undefined || !Number.isFinite(value) || most === 0 ? kForceless : diverging(value / most, kForceless);
  }

  #solid(): Mesh {
    const { what, hidden } = this.shown;
    const geometry = new BufferGeometry();
    geometry.setAttribute('position', this.#positions);
    geometry.setIndex(new BufferAttribute(this.source.triangles, 1));
    const isColored = this.range !== null && !isSequence(what);
    const side = { side: DoubleSide, flatShading: true, polygonOffset: true, polygonOffsetFactor: 1, polygonOffsetUnits: 1 };
    if (isColored) geometry.setAttribute('color', this.#colors(this.range!));
    const glass = isSequence(what) ? { transparent: true, opacity: kGlass, depthWrite: false } : {};
    const materials = this.source.parts.map(({ name }) => new MeshLambertMaterial(isColored ? { ...side, vertexColors: true } : { ...side, ...glass, color: partColor(name) }));
    this.source.parts.forEach((part, k) => {
      if (!hidden.has(part.name)) geometry.addGroup(3 * part.first, 3 * part.count, k);
    });
    const mesh = new Mesh(geometry, materials);
    mesh.frustumCulled = false;
    return mesh;
  }

  #colors([least, greatest]: [number, number]): BufferAttribute {
    const values = this.values!;
    const colors = new Float32Array(values.length * 3);
    const color = new Color();
    for (let k = 0; k < values.length; ++k) {
      const [r, g, b] = viridis(greatest > least ? (values[k]! - least) / (greatest - least) : 0.5);
      color.setRGB(r / 255, g / 255, b / 255, SRGBColorSpace).toArray(colors, 3 * k);
    }
    return new BufferAttribute(colors, 3);
  }

  #makeRods(): void {
    for (const rod of this.source.rods) {
      for (let k = rod.first; k < rod.first + rod.count; ++k) {
        this.#ends.push(this.source.edges[2 * k]!, this.source.edges[2 * k + 1]!);
        this.#names.push(rod.name);
      }
    }
    this.#rods = new Rods(this.#names.length);
    this.objects.push(this.#rods.mesh);
  }

  #rodColor(a: number, b: number): Rgb {
    const value = this.range ? (this.values![a]! + this.values![b]!) / 2 : NaN;
    if (isSequence(this.shown.what)) return this.#force(value);
    const [least, greatest] = this.range ?? [0, 0];
    return Number.isFinite(value) ? viridis(greatest > least ? (value - least) / (greatest - least) : 0.5) : kForceless;
  }

  #placeRods(): void {
    if (!this.#rods) return;
    const [a, b] = [new Vector3(), new Vector3()];
    for (let k = 0; k < this.#names.length; ++k) {
      const [from, to] = [this.#ends[2 * k]!, this.#ends[2 * k + 1]!];
      this.#rods.place(k, a.fromBufferAttribute(this.#positions, from), b.fromBufferAttribute(this.#positions, to), this.#thickness);
      this.#rods.paint(k, this.#rodColor(from, to));
    }
    this.#rods.placed();
  }

  #makeArrows(sequence: SceneSequence, radius: number): void {
    this.#arrows = new Arrows(sequence, {
      length: kArrow * radius * this.shown.arrows,
      thickness: 0.0055 * radius,
      color: (arrow, values) => {
        const value = values?.[sequence.arrows[arrow]!.point];
        return value !== undefined && Number.isFinite(value) ? this.#force(value) : this.shown.load;
      },
    });
    this.objects.push(...this.#arrows.objects);
  }

  #makeRoad(road: SceneMesh): void {
    const geometry = new BufferGeometry();
    geometry.setAttribute('position', new BufferAttribute(road.points, 3));
    geometry.setIndex(new BufferAttribute(road.triangles, 1));
    const heights = road.points.filter((_, k) => k % 3 === 2);
    geometry.setAttribute('color', this.#reliefs(heights, fieldRange(heights)));
    this.#road = new Mesh(geometry, new MeshLambertMaterial({ vertexColors: true, side: DoubleSide, flatShading: true }));
    this.#road.frustumCulled = false;
    this.objects.push(this.#road);
  }

  /** Colors higher points darker: kerbs are low compared with a car. */
  #reliefs(heights: Float32Array, [least, greatest]: [number, number]): BufferAttribute {
    const [low, high, color] = [new Color(partColor('road')), new Color(kCrest), new Color()];
    const colors = new Float32Array(3 * heights.length);
    heights.forEach((height, k) => color.lerpColors(low, high, greatest > least ? (height - least) / (greatest - least) : 0).toArray(colors, 3 * k));
    return new BufferAttribute(colors, 3);
  }

  /** Draws edges that belong to no rod. */
  #edges(): void {
    const isRod = new Set(this.source.rods.flatMap((rod) => Array.from({ length: rod.count }, (_, k) => rod.first + k)));
    const lines = this.source.edges.filter((_, k) => !isRod.has(k >> 1));
    if (!lines.length) return;
    const geometry = new BufferGeometry();
    geometry.setAttribute('position', this.#positions);
    geometry.setIndex(new BufferAttribute(lines, 1));
    const made = new LineSegments(geometry, new LineBasicMaterial({ color: this.shown.ink, transparent: true, opacity: 0.35 }));
    made.frustumCulled = false;
    this.objects.push(made);
  }

  #level(height: number): Mesh {
    const { center, radius } = extentOf(this.source.points);
    const plane = new Mesh(new PlaneGeometry(2.4 * radius, 2.4 * radius), new MeshBasicMaterial({ color: this.shown.ink, transparent: true, opacity: 0.12, side: DoubleSide, depthWrite: false, polygonOffset: true, polygonOffsetFactor: 4, polygonOffsetUnits: 4 }));
    plane.position.set(center[0], center[1], height);
    return plane;
  }
}
