// SPDX-License-Identifier: Apache-2.0
// Vectors of space, and 4 x 4 matrices by columns as WebGL takes them.

export type Vector = readonly [number, number, number];

export const plus = (a: Vector, b: Vector, factor = 1): Vector => [a[0] + factor * b[0], a[1] + factor * b[1], a[2] + factor * b[2]];
export const minus = (a: Vector, b: Vector): Vector => plus(a, b, -1);
export const times = (a: Vector, factor: number): Vector => [a[0] * factor, a[1] * factor, a[2] * factor];
export const dot = (a: Vector, b: Vector): number => a[0] * b[0] + a[1] * b[1] + a[2] * b[2];
export const cross = (a: Vector, b: Vector): Vector => [a[1] * b[2] - a[2] * b[1], a[2] * b[0] - a[0] * b[2], a[0] * b[1] - a[1] * b[0]];
export const length = (a: Vector): number => Math.hypot(...a);
export const unit = (a: Vector): Vector => times(a, 1 / length(a));

/** Point k of an array of points. */
export const pointOf = (points: Float32Array, k: number): Vector => [points[3 * k]!, points[3 * k + 1]!, points[3 * k + 2]!];

/** Linear red, green and blue, 0 to 1, of bytes of sRGB (IEC 61966-2-1). */
export function linear(bytes: Vector): Vector {
  const [r, g, b] = bytes.map((byte) => (byte <= 10.31475 ? byte / 3294.6 : ((byte / 255 + 0.055) / 1.055) ** 2.4));
  return [r!, g!, b!];
}

/** Bytes of a color such as "#8fb3d1". */
export function bytesOf(color: string): [number, number, number] {
  return [1, 3, 5].map((at) => parseInt(color.slice(at, at + 2), 16)) as [number, number, number];
}
