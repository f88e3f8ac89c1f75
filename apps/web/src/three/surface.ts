// SPDX-License-Identifier: Apache-2.0
// The target over two variables as a surface in a box of 2 x 2 x 1: height and color show the target on its scale.

import { BufferAttribute, BufferGeometry, Color, DoubleSide, LineBasicMaterial, LineSegments, Mesh, MeshLambertMaterial, SphereGeometry, SRGBColorSpace } from 'three';

import type { Surface, SurfaceAxis, Value } from '../lib/contract';
import { named, number } from '../lib/numbers';
import { viridis } from '../lib/palette';
import type { Levels } from '../views/target/levels';
import type { Label } from './stage';

type Place = [number, number, number];

function along(axis: SurfaceAxis, value: number): number {
  const way = axis.scale === 'logarithmic' ? Math.log : (x: number) => x;
  const [least, greatest] = [way(axis.levels[0]!), way(axis.levels.at(-1)!)];
  return greatest === least ? 0 : (2 * (way(value) - least)) / (greatest - least) - 1;
}

const edgePairs = (nx: number, ny: number) => {
  const pairs: number[] = [];
  for (let i = 0; i < nx; ++i) {
    for (let j = 0; j < ny; ++j) {
      if (i + 1 < nx) pairs.push(i * ny + j, (i + 1) * ny + j);
      if (j + 1 < ny) pairs.push(i * ny + j, i * ny + j + 1);
    }
  }
  return pairs;
};

export function surfaceMesh(surface: Surface, levels: Levels, ink: string): { mesh: Mesh; grid: LineSegments } {
  const [nx, ny] = [surface.x.levels.length, surface.y.levels.length];
  const places = new Float32Array(nx * ny * 3);
  const colors = new Float32Array(nx * ny * 3);
  const isKnown = (k: number) => Number.isFinite(surface.target[Math.floor(k / ny)]?.[k % ny] ?? NaN);
  const color = new Color();
  for (let k = 0; k < nx * ny; ++k) {
    const [i, j] = [Math.floor(k / ny), k % ny];
    const part = isKnown(k) ? levels.part(surface.target[i]![j]!) : 0;
    places.set([along(surface.x, surface.x.levels[i]!), along(surface.y, surface.y.levels[j]!), part], 3 * k);
    const [r, g, b] = viridis(part);
    color.setRGB(r / 255, g / 255, b / 255, SRGBColorSpace).toArray(colors, 3 * k);
  }
  const triangles: number[] = [];
  for (let i = 0; i + 1 < nx; ++i) {
    for (let j = 0; j + 1 < ny; ++j) {
      const [a, b, c, d] = [i * ny + j, (i + 1) * ny + j, (i + 1) * ny + j + 1, i * ny + j + 1];
      if ([a, b, c, d].every(isKnown)) triangles.push(a, b, c, a, c, d);
    }
  }
  const geometry = new BufferGeometry();
  geometry.setAttribute('position', new BufferAttribute(places, 3));
  geometry.setAttribute('color', new BufferAttribute(colors, 3));
  geometry.setIndex(triangles);
  geometry.computeVertexNormals();
  const mesh = new Mesh(geometry, new MeshLambertMaterial({ vertexColors: true, side: DoubleSide, polygonOffset: true, polygonOffsetFactor: 1, polygonOffsetUnits: 1 }));
  const lines = new BufferGeometry();
  lines.setAttribute('position', geometry.getAttribute('position'));
  lines.setIndex(edgePairs(nx, ny).filter((_, k, all) => isKnown(all[k - (k % 2)]!) && isKnown(all[k - (k % 2) + 1]!)));
  const grid = new LineSegments(lines, new LineBasicMaterial({ color: ink, transparent: true, opacity: 0.35 }));
  return { mesh, grid };
}

/** The frame below the surface and around it. */
export function box(ink: string): LineSegments {
  const geometry = new BufferGeometry();
  const corners = [[-1, -1], [1, -1], [1, 1], [-1, 1]] as const;
  const places = corners.flatMap(([x, y], k) => {
    const [nextX, nextY] = corners[(k + 1) % 4]!;
    return [x, y, 0, nextX, nextY, 0, x, y, 0, x, y, 1];
  });
  geometry.setAttribute('position', new BufferAttribute(new Float32Array(places), 3));
  return new LineSegments(geometry, new LineBasicMaterial({ color: ink, transparent: true, opacity: 0.4 }));
}

export function labels(surface: Surface, levels: Levels): Label[] {
  const ticks = (axis: SurfaceAxis, at: (part: number) => Place): Label[] => {
    const count = axis.levels.length;
    const shown = count <= 5 ? axis.levels : [0, 0.25, 0.5, 0.75, 1].map((part) => axis.levels[Math.round(part * (count - 1))]!);
    return shown.map((level) => ({ text: number(level, 3), at: at(along(axis, level)) }));
  };
  return [
    ...ticks(surface.x, (x) => [x, -1.13, 0]),
    ...ticks(surface.y, (y) => [1.13, y, 0]),
    { text: named(surface.x.name, surface.x.unit), at: [0, -1.52, 0], isStrong: true },
    { text: named(surface.y.name, surface.y.unit), at: [1.52, 0, 0], isStrong: true },
    { text: `${number(levels.least * 100, 3)} %`, at: [-1.24, -1, 0.05] },
    { text: `${number(levels.greatest * 100, 3)} %`, at: [-1.24, -1, 1] },
  ];
}

/** Position of a point of the variables on the surface: above the nearest point of the grid. */
export function placeOn(surface: Surface, levels: Levels, [x, y]: [Value, Value]): Place | null {
  if (x === null || y === null) return null;
  const closest = (axis: SurfaceAxis, value: number) => axis.levels.reduce((best, level, k) => (Math.abs(along(axis, level) - along(axis, value)) < Math.abs(along(axis, axis.levels[best]!) - along(axis, value)) ? k : best), 0);
  const value = surface.target[closest(surface.x, x)]?.[closest(surface.y, y)];
  return value === null || value === undefined ? null : [along(surface.x, x), along(surface.y, y), levels.part(value)];
}

export function ball(at: Place, color: string, radius: number): Mesh {
  const mesh = new Mesh(new SphereGeometry(radius, 20, 14), new MeshLambertMaterial({ color }));
  mesh.position.set(...at);
  return mesh;
}
