// SPDX-License-Identifier: Apache-2.0
// A mesh on the stage: its parts in colors of their own or all in those of a field, displaced or vibrating in a mode;
// its rods (links of a suspension) in the colors of their forces; a step of a test, with arrows and the road below.

import { diverging, kForceless, type Rgb, viridis } from '../lib/palette';
import { partColor } from '../lib/part_colors';
import { Arrows } from './arrows';
import type { Hit } from './picking';
import { RodSet } from './rods';
import { extentOf, fieldRange, type SceneData, type SceneFrame, type SceneMesh, type SceneSequence, signedRange, stepOf } from './scene_data';
import { type Drawn, type Lines, type Numbers, numbers, type Rods, type Solid } from './things';
import { bytesOf, length, linear, minus, plus, pointOf, times, type Vector } from './vectors';

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
  readonly things: Drawn[] = [];
  readonly mesh: Solid;
  readonly source: SceneMesh;
  readonly range: [number, number] | null;
  points: Float32Array; // points of the displayed step or frame
  values: Float32Array | null;
  #positions: Numbers; // places at which the points are drawn
  #center: Vector;
  #rods: RodSet | null = null;
  #ends: number[] = []; // points of the rods, two each
  #names: string[] = []; // names of the rods
  #arrows: Arrows | null = null;
  #road: Solid | null = null;
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
    this.#positions = numbers(new Float32Array(this.source.points.length));
    const { center, radius } = extentOf(this.source.points);
    this.#center = center;
    this.range = what.field && shown.hasField ? (isSequence(what) ? signedRange : fieldRange)(what.field.values) : null;
    this.mesh = this.#solid();
    this.things.push(this.mesh);
    this.#thickness = 0.007 * radius;
    if (this.source.rods.length) this.#makeRods();
    if (shown.hasEdges) this.#edges();
    if (isSequence(what)) {
      if (shown.hasForces && what.arrows.length) this.#makeArrows(what, radius);
      if (what.ground !== null) this.#makeRoad(data.meshes[what.ground]!);
      this.show(0);
    } else {
      if (what.ground !== null) this.things.push(this.#level(what.ground, radius));
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
    this.#arrows?.place(this.#positions.data, now.vectors, now.values);
    if (this.#road) this.#road.at = [-what.origins[step]!, 0, 0];
  }

  /** Places points at this sine of a mode's oscillation; without a mode at their positions in the frame. */
  place(sine: number): void {
    const { what, exaggeration } = this.shown;
    const rest = this.source.points;
    const swing = isSequence(what) ? null : what.swing;
    const to = this.#positions.data;
    const share = swing ? sine * exaggeration : 0;
    const drawn = swing ? 1 : exaggeration;
    for (let k = 0; k < to.length; ++k) {
      to[k] = rest[k]! + drawn * (this.points[k]! - rest[k]!) + (swing ? share * swing[k]! : 0);
    }
    ++this.#positions.version;
    this.#placeRods();
  }

  /** What the probe searches. */
  get bodies(): (Solid | Rods)[] {
    const solid = this.source.triangles.length ? [this.mesh] : [];
    return [...(this.#arrows?.things ?? []), ...(this.#rods ? [this.#rods.thing] : []), ...solid];
  }

  found({ object, nearest, point }: Hit): Found {
    if (object.kind === 'solid') return { point: nearest, rod: null, arrow: null };
    if (object !== this.#rods?.thing) return { point: this.#arrows!.sequence.arrows[nearest]!.point, rod: null, arrow: nearest };
    const [a, b] = [this.#ends[2 * nearest]!, this.#ends[2 * nearest + 1]!];
    const distance = (k: number) => length(minus(point, pointOf(this.#positions.data, k)));
    return { point: distance(a) < distance(b) ? a : b, rod: this.#names[nearest]!, arrow: null };
  }

  /** The color of a force; without a value that of no force. */
  #force(value: number | undefined): Rgb {
    const most = this.range?.[1] ?? 0;
    return value === undefined || !Number.isFinite(value) || most === 0 ? kForceless : diverging(value / most, kForceless);
  }

  #solid(): Solid {
    const { what, hidden } = this.shown;
    const isGlass = isSequence(what);
    const all = this.source.parts.map(({ name, first, count }) => ({ name, first: 3 * first, count: 3 * count, color: linear(bytesOf(partColor(name))) }));
    return {
      kind: 'solid', at: [0, 0, 0], center: this.#center, points: this.#positions, triangles: this.source.triangles, normals: null,
      colors: this.range !== null && !isGlass ? this.#colors(this.range) : null, parts: all.filter(({ name }) => !hidden.has(name)),
      opacity: isGlass ? kGlass : 1, isVeil: isGlass, hasBack: true, isLit: true, behind: 1,
    };
  }

  #colors([least, greatest]: [number, number]): Numbers {
    const colors = new Float32Array(this.values!.length * 3);
    this.values!.forEach((value, k) => colors.set(linear(viridis(greatest > least ? (value - least) / (greatest - least) : 0.5)), 3 * k));
    return numbers(colors);
  }

  #makeRods(): void {
    for (const rod of this.source.rods) {
      for (let k = rod.first; k < rod.first + rod.count; ++k) {
        this.#ends.push(this.source.edges[2 * k]!, this.source.edges[2 * k + 1]!);
        this.#names.push(rod.name);
      }
    }
    this.#rods = new RodSet(this.#names.length);
    this.things.push(this.#rods.thing);
  }

  #rodColor(a: number, b: number): Rgb {
    const value = this.range ? (this.values![a]! + this.values![b]!) / 2 : NaN;
    if (isSequence(this.shown.what)) return this.#force(value);
    const [least, greatest] = this.range ?? [0, 0];
    return Number.isFinite(value) ? viridis(greatest > least ? (value - least) / (greatest - least) : 0.5) : kForceless;
  }

  #placeRods(): void {
    if (!this.#rods) return;
    const points = this.#positions.data;
    for (let k = 0; k < this.#names.length; ++k) {
      const [from, to] = [this.#ends[2 * k]!, this.#ends[2 * k + 1]!];
      this.#rods.place(k, pointOf(points, from), pointOf(points, to), this.#thickness);
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
    this.things.push(...this.#arrows.things);
  }

  #makeRoad(road: SceneMesh): void {
    const heights = road.points.filter((_, k) => k % 3 === 2);
    this.#road = {
      kind: 'solid', at: [0, 0, 0], center: extentOf(road.points).center, opacity: 1, points: numbers(road.points), triangles: road.triangles, normals: null,
      colors: this.#reliefs(heights, fieldRange(heights)), parts: [{ first: 0, count: road.triangles.length, color: [0, 0, 0] }],
      hasBack: true, isLit: true, behind: 0, isVeil: false,
    };
    this.things.push(this.#road);
  }

  /** Colors higher points darker: kerbs are low compared with a car. */
  #reliefs(heights: Float32Array, [least, greatest]: [number, number]): Numbers {
    const [low, high] = [linear(bytesOf(partColor('road'))), linear(bytesOf(kCrest))];
    const colors = new Float32Array(3 * heights.length);
    heights.forEach((height, k) => colors.set(plus(low, minus(high, low), greatest > least ? (height - least) / (greatest - least) : 0), 3 * k));
    return numbers(colors);
  }

  /** Draws edges that belong to no rod. */
  #edges(): void {
    const isRod = new Set(this.source.rods.flatMap((rod) => Array.from({ length: rod.count }, (_, k) => rod.first + k)));
    const lines = this.source.edges.filter((_, k) => !isRod.has(k >> 1));
    if (!lines.length) return;
    const edges: Lines = { kind: 'lines', at: [0, 0, 0], center: this.#center, opacity: 0.35, points: this.#positions, pairs: lines, color: linear(bytesOf(this.shown.ink)) };
    this.things.push(edges);
  }

  /** The ground, a square around the model. */
  #level(height: number, radius: number): Solid {
    const [x, y] = this.#center;
    const corners = [[-1, -1], [1, -1], [1, 1], [-1, 1]].flatMap((corner) => [...times([corner[0]!, corner[1]!, 0], 1.2 * radius)]);
    return {
      kind: 'solid', at: [x, y, height], center: [0, 0, 0], opacity: 0.12, points: numbers(new Float32Array(corners)), triangles: new Uint32Array([0, 1, 2, 0, 2, 3]),
      normals: null, colors: null, parts: [{ first: 0, count: 6, color: linear(bytesOf(this.shown.ink)) }], hasBack: true, isLit: false, behind: 4, isVeil: true,
    };
  }
}
