// SPDX-License-Identifier: Apache-2.0
// Decodes a scene of the server (docs/studio.md): the length of a JSON text, the text, the arrays it names.

interface Span {
  at: number;
  count: number;
}

export interface Part {
  name: string;
  first: number;
  count: number;
}

export interface SceneMesh {
  name: string;
  points: Float32Array;
  triangles: Uint32Array;
  edges: Uint32Array;
  parts: Part[];
  rods: Part[]; // ranges of edges
}

export interface SceneFrame {
  name: string;
  mesh: number;
  points: Float32Array;
  field: { name: string; unit: string; values: Float32Array } | null;
  swing: Float32Array | null;
  frequency: number | null;
  ground: number | null;
}

export interface SceneArrow {
  name: string;
  unit: string;
  point: number;
  is_load: boolean;
}

/** A test step by step: the states of a rig or moments of a run. */
export interface SceneSequence {
  name: string;
  mesh: number;
  along: string;
  unit: string;
  at: (number | null)[];
  origins: number[]; // distance along x of the origin of the points
  points: Float32Array; // for all steps
  field: { name: string; unit: string; values: Float32Array } | null;
  arrows: SceneArrow[];
  vectors: Float32Array; // for all steps, in the arrows' units
  ground: number | null; // index of a mesh that does not move
}

export interface SceneData {
  title: string;
  unit: string;
  meshes: SceneMesh[];
  frames: SceneFrame[];
  sequences: SceneSequence[];
  remarks: string[]; // names of omitted data
}

interface Told {
  title: string;
  unit: string;
  meshes: { name: string; points: Span; triangles: Span; edges?: Span | null; parts?: Part[]; rods?: Part[] }[];
  frames: {
    name: string;
    mesh: number | string;
    points: Span;
    field: { name: string; unit: string; values: Span } | null;
    swing: Span | null;
    frequency: number | null;
    ground: number | null;
  }[];
  sequences?: {
    name: string;
    mesh: string;
    along: string;
    unit: string;
    at: (number | null)[];
    origins: (number | null)[];
    points: Span;
    field: { name: string; unit: string; values: Span } | null;
    arrows: SceneArrow[];
    vectors: Span;
    ground: string | null;
  }[];
  remarks?: string[];
}

export function readScene(buffer: ArrayBuffer): SceneData {
  const length = new DataView(buffer).getUint32(0, true);
  const told = JSON.parse(new TextDecoder().decode(new Uint8Array(buffer, 4, length))) as Told;
  const begin = 4 + length;
  const bytes = ({ at, count }: Span) => buffer.slice(begin + at, begin + at + 4 * count);
  const floats = (span: Span) => new Float32Array(bytes(span));
  const integers = (span: Span | null | undefined) => (span ? new Uint32Array(bytes(span)) : new Uint32Array());
  const meshes = told.meshes.map((mesh) => {
    const triangles = integers(mesh.triangles);
    const parts = mesh.parts?.length ? mesh.parts : [{ name: mesh.name, first: 0, count: triangles.length / 3 }];
    const edges = integers(mesh.edges);
    const rods = mesh.rods?.length ? mesh.rods : triangles.length ? [] : [{ name: mesh.name, first: 0, count: edges.length / 2 }];
    return { name: mesh.name, points: floats(mesh.points), triangles, edges, parts, rods };
  });
  const numberOf = (name: string) => Math.max(meshes.findIndex((mesh) => mesh.name === name), 0);
  const frames = told.frames.map((frame) => ({
    name: frame.name,
    mesh: typeof frame.mesh === 'number' ? frame.mesh : numberOf(frame.mesh),
    points: floats(frame.points),
    field: frame.field && { name: frame.field.name, unit: frame.field.unit, values: floats(frame.field.values) },
    swing: frame.swing && floats(frame.swing),
    frequency: frame.frequency,
    ground: frame.ground,
  }));
  const sequences = (told.sequences ?? []).map((one) => ({
    ...one,
    mesh: numberOf(one.mesh),
    origins: one.origins.map((origin) => origin ?? 0),
    points: floats(one.points),
    field: one.field && { name: one.field.name, unit: one.field.unit, values: floats(one.field.values) },
    vectors: floats(one.vectors),
    ground: one.ground === null ? null : numberOf(one.ground),
  }));
  return { title: told.title, unit: told.unit, meshes, frames, sequences, remarks: told.remarks ?? [] };
}

export function fieldRange(values: Float32Array): [number, number] {
  let [least, greatest] = [Infinity, -Infinity];
  for (const value of values) {
    if (value < least) least = value;
    if (value > greatest) greatest = value;
  }
  return Number.isFinite(least) ? [least, greatest] : [0, 1];
}

/** A range symmetric to zero that contains the values. */
export function signedRange(values: Float32Array): [number, number] {
  let most = 0;
  for (const value of values) if (Math.abs(value) > most) most = Math.abs(value);
  return [-most, most];
}

/** A step of a sequence: views of its arrays. */
export function stepOf(sequence: SceneSequence, step: number): { points: Float32Array; values: Float32Array | null; vectors: Float32Array } {
  const part = (all: Float32Array) => all.subarray((step * all.length) / sequence.at.length, ((step + 1) * all.length) / sequence.at.length);
  return { points: part(sequence.points), values: sequence.field && part(sequence.field.values), vectors: part(sequence.vectors) };
}

/** The step with the largest forces, which shows most. */
export function strongestStep(sequence: SceneSequence): number {
  let [best, most] = [0, -1];
  for (let step = 0; step < sequence.at.length; ++step) {
    const sum = stepOf(sequence, step).vectors.reduce((all, value) => all + value * value, 0);
    if (sum > most) [best, most] = [step, sum];
  }
  return best;
}

/** The longest arrow of a unit over all steps. */
export function longestArrow(sequence: SceneSequence, unit: string): number {
  let most = 0;
  const count = sequence.arrows.length;
  for (let k = 0; k < sequence.vectors.length / 3; ++k) {
    if (sequence.arrows[k % count]!.unit !== unit) continue;
    most = Math.max(most, Math.hypot(sequence.vectors[3 * k]!, sequence.vectors[3 * k + 1]!, sequence.vectors[3 * k + 2]!));
  }
  return most;
}

/** The extent of the points along each axis, half its diagonal, and its middle. */
export function extentOf(points: Float32Array): { center: [number, number, number]; radius: number; sizes: number[] } {
  const least = [Infinity, Infinity, Infinity];
  const greatest = [-Infinity, -Infinity, -Infinity];
  for (let k = 0; k < points.length; ++k) {
    const axis = k % 3;
    if (points[k]! < least[axis]!) least[axis] = points[k]!;
    if (points[k]! > greatest[axis]!) greatest[axis] = points[k]!;
  }
  const center = least.map((low, axis) => (low + greatest[axis]!) / 2) as [number, number, number];
  const sizes = least.map((low, axis) => greatest[axis]! - low);
  return { center, radius: Math.hypot(...sizes) / 2 || 1, sizes };
}
