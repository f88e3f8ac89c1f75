// SPDX-License-Identifier: Apache-2.0
// Shapes that stand for links, arrows and points: cylinder, cone, ball.

import type { Shape } from './things';

/** A body of revolution about y through rings of these radii, heights and slopes (normals' y over their radial part). */
function turned(rings: readonly { radius: number; y: number; radial: number; axial: number }[], around: number): Shape {
  const [points, normals, triangles]: [number[], number[], number[]] = [[], [], []];
  for (const { radius, y, radial, axial } of rings) {
    for (let k = 0; k <= around; ++k) {
      const angle = (2 * Math.PI * k) / around;
      const [x, z] = [Math.sin(angle), Math.cos(angle)];
      points.push(radius * x, y, radius * z);
      normals.push(radial * x, axial, radial * z);
    }
  }
  for (let ring = 0; ring + 1 < rings.length; ++ring) {
    if (rings[ring]!.y === rings[ring + 1]!.y && rings[ring]!.radius === rings[ring + 1]!.radius) continue; // an edge
    for (let k = 0; k < around; ++k) {
      const a = ring * (around + 1) + k;
      const b = a + around + 1;
      triangles.push(a, b, a + 1, b, b + 1, a + 1);
    }
  }
  return { points: new Float32Array(points), normals: new Float32Array(normals), triangles: new Uint32Array(triangles) };
}

const cap = (radius: number, y: number) => ({ radius, y, radial: 0, axial: Math.sign(y) });

export function cylinder(around: number): Shape {
  const wall = (y: number) => ({ radius: 1, y, radial: 1, axial: 0 });
  return turned([cap(0, 0.5), cap(1, 0.5), wall(0.5), wall(-0.5), cap(1, -0.5), cap(0, -0.5)], around);
}

/** Its tip is at y = 0.5. */
export function cone(around: number): Shape {
  const wall = (radius: number, y: number) => ({ radius, y, radial: Math.SQRT1_2, axial: Math.SQRT1_2 });
  return turned([wall(0, 0.5), wall(1, -0.5), cap(1, -0.5), cap(0, -0.5)], around);
}

export function ball(radius: number, around: number, rings: number): Shape {
  const ring = (k: number) => {
    const [radial, axial] = [Math.sin((Math.PI * k) / rings), Math.cos((Math.PI * k) / rings)];
    return { radius: radius * radial, y: radius * axial, radial, axial };
  };
  return turned(Array.from({ length: rings + 1 }, (_, k) => ring(k)), around);
}
