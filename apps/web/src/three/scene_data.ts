// SPDX-License-Identifier: Apache-2.0
// A scene as it comes from the server (docs/studio.md): the length of a JSON text, the text, the arrays it names.

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

export interface SceneData {
  title: string;
  unit: string;
  meshes: SceneMesh[];
  frames: SceneFrame[];
}

interface Told {
  title: string;
  unit: string;
  meshes: { name: string; points: Span; triangles: Span; edges?: Span | null; parts?: Part[] }[];
  frames: {
    name: string;
    mesh: number | string;
    points: Span;
    field: { name: string; unit: string; values: Span } | null;
    swing: Span | null;
    frequency: number | null;
    ground: number | null;
  }[];
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
    return { name: mesh.name, points: floats(mesh.points), triangles, edges: integers(mesh.edges), parts };
  });
  const frames = told.frames.map((frame) => ({
    name: frame.name,
    mesh: typeof frame.mesh === 'number' ? frame.mesh : Math.max(meshes.findIndex((mesh) => mesh.name === frame.mesh), 0),
    points: floats(frame.points),
    field: frame.field && { name: frame.field.name, unit: frame.field.unit, values: floats(frame.field.values) },
    swing: frame.swing && floats(frame.swing),
    frequency: frame.frequency,
    ground: frame.ground,
  }));
  return { title: told.title, unit: told.unit, meshes, frames };
}

export function fieldRange(values: Float32Array): [number, number] {
  let [least, greatest] = [Infinity, -Infinity];
  for (const value of values) {
    if (value < least) least = value;
    if (value > greatest) greatest = value;
  }
  return Number.isFinite(least) ? [least, greatest] : [0, 1];
}

/** What the points span along each axis, half its diagonal, and its middle. */
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
