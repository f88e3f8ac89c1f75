// SPDX-License-Identifier: Apache-2.0
// Colors of fields: viridis (Smith, van der Walt 2015), eleven of its colors with linear interpolation between them.
// Lines have the colors of Okabe and Ito (2008), as variables of app.css.

const kViridis = [
  [68, 1, 84], [72, 36, 117], [65, 68, 135], [53, 95, 141], [42, 120, 142], [33, 145, 140],
  [34, 168, 132], [68, 191, 112], [122, 209, 81], [189, 223, 38], [253, 231, 37],
] as const;

export type Rgb = [number, number, number];

export function viridis(part: number): Rgb {
  const at = Math.min(Math.max(Number.isFinite(part) ? part : 0, 0), 1) * (kViridis.length - 1);
  const below = Math.min(Math.floor(at), kViridis.length - 2);
  const [from, to] = [kViridis[below]!, kViridis[below + 1]!];
  const share = at - below;
  return [0, 1, 2].map((k) => Math.round(from[k]! + share * (to[k]! - from[k]!))) as Rgb;
}

export function css([r, g, b]: Rgb): string {
  return `rgb(${r} ${g} ${b})`;
}

/** Black or white, whichever has the higher contrast on this color (WCAG 2.1, relative luminance). */
export function inkOn(color: Rgb): string {
  const [r, g, b] = color.map((byte) => (byte <= 10 ? byte / 3294 : ((byte / 255 + 0.055) / 1.055) ** 2.4)) as Rgb;
  return 0.2126 * r + 0.7152 * g + 0.0722 * b > 0.179 ? '#000000' : '#ffffff';
}

/** Color of -1 (blue) through `paper` at 0 to 1 (vermilion): correlations on paper, forces on kForceless. */
export function diverging(value: number, paper: Rgb): Rgb {
  const end = value < 0 ? [0, 114, 178] : [213, 94, 0];
  const share = Math.min(Math.abs(value), 1);
  return [0, 1, 2].map((k) => Math.round(paper[k]! + share * (end[k]! - paper[k]!))) as Rgb;
}

export const kForceless: Rgb = [168, 176, 184];

export const kLineColors = ['--line-1', '--line-2', '--line-3', '--line-4', '--line-5', '--line-6', '--line-7', '--line-8'] as const;
