// SPDX-License-Identifier: Apache-2.0
// Finds what is below the pointer: the nearest triangle of a solid or the nearest rod on the ray through it.

import type { Ray } from './camera';
import type { Rods, Solid } from './things';
import { cross, dot, length, minus, plus, pointOf, type Vector } from './vectors';

export interface Hit {
  object: Solid | Rods;
  point: Vector;
  nearest: number; // index of the corner of the triangle that is nearest to the point, or of the rod
  distance: number; // its way from the eye
}

export function hit(objects: readonly (Solid | Rods)[], ray: Ray): Hit | null {
  let best: Hit | null = null;
  for (const object of objects) {
    const found = object.kind === 'rods' ? rodOn(object, ray) : triangleOn(object, ray);
    if (found && (!best || found.distance < best.distance)) best = found;
  }
  return best;
}

/** The intersection of Möller and Trumbore (1997), without its vectors: meshes have a hundred thousand triangles. */
function triangleOn(solid: Solid, ray: Ray): Hit | null {
  const [ox, oy, oz] = minus(ray.from, solid.at);
  const [dx, dy, dz] = ray.along;
  const p = solid.points.data;
  let [distance, triangle] = [Infinity, -1];
  for (const { first, count } of solid.parts) {
    for (let at = first; at < first + count; at += 3) {
      const [a, b, c] = [3 * solid.triangles[at]!, 3 * solid.triangles[at + 1]!, 3 * solid.triangles[at + 2]!];
      const [ax, ay, az] = [p[a]!, p[a + 1]!, p[a + 2]!];
      const [ux, uy, uz] = [p[b]! - ax, p[b + 1]! - ay, p[b + 2]! - az];
      const [vx, vy, vz] = [p[c]! - ax, p[c + 1]! - ay, p[c + 2]! - az];
      const [nx, ny, nz] = [dy * vz - dz * vy, dz * vx - dx * vz, dx * vy - dy * vx];
      const determinant = ux * nx + uy * ny + uz * nz;
      if (determinant === 0) continue;
      const [fx, fy, fz] = [ox - ax, oy - ay, oz - az];
      const u = (fx * nx + fy * ny + fz * nz) / determinant;
      if (!(u >= 0 && u <= 1)) continue;
      const [qx, qy, qz] = [fy * uz - fz * uy, fz * ux - fx * uz, fx * uy - fy * ux];
      const v = (dx * qx + dy * qy + dz * qz) / determinant;
      if (!(v >= 0 && u + v <= 1)) continue;
      const reach = (vx * qx + vy * qy + vz * qz) / determinant;
      if (reach > 0 && reach < distance) [distance, triangle] = [reach, at];
    }
  }
  if (triangle < 0) return null;
  const point = plus(ray.from, ray.along, distance);
  const corners = [0, 1, 2].map((k) => solid.triangles[triangle + k]!);
  const far = (k: number) => length(minus(plus(pointOf(p, k), solid.at), point));
  return { object: solid, point, distance, nearest: corners.reduce((near, k) => (far(k) < far(near) ? k : near)) };
}

/** The nearest rod whose axis passes the ray within its radius. */
function rodOn(rods: Rods, ray: Ray): Hit | null {
  let best: Hit | null = null;
  const ends = rods.ends.data;
  for (let k = 0; 7 * k < ends.length; ++k) {
    const from = plus([ends[7 * k]!, ends[7 * k + 1]!, ends[7 * k + 2]!], rods.at);
    const axis = minus(plus([ends[7 * k + 3]!, ends[7 * k + 4]!, ends[7 * k + 5]!], rods.at), from);
    const radius = ends[7 * k + 6]!;
    const square = dot(axis, axis);
    if (radius === 0 || square === 0) continue;
    const normal = cross(ray.along, axis);
    const start = minus(from, ray.from);
    // The place of the axis that is nearest to the ray, between the rod's ends; where both are parallel, its beginning.
    const sine = dot(normal, normal);
    const share = sine > 1e-12 * square ? Math.min(Math.max(dot(cross(start, ray.along), normal) / sine, 0), 1) : 0;
    const place = plus(start, axis, share);
    const reach = dot(place, ray.along);
    const apart = length(minus(place, plus([0, 0, 0], ray.along, reach)));
    if (reach <= 0 || apart > radius) continue;
    const distance = reach - Math.sqrt(radius * radius - apart * apart);
    if (!best || distance < best.distance) best = { object: rods, point: plus(ray.from, ray.along, distance), nearest: k, distance };
  }
  return best;
}
