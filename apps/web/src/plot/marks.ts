// SPDX-License-Identifier: Apache-2.0
// The marks of a plot: lines, steps, points, bands, cells, marks on an edge. Abscissas may have any order, so loops and
// paths are lines like others. Points are rectangles, because 50 000 arcs take five times as long.

import type { Value } from '../lib/contract';

export interface Mark {
  kind: 'line' | 'steps' | 'points' | 'band' | 'cells' | 'edge' | 'vertical' | 'horizontal' | 'stems';
  name: string;
  color: string; // "--found": a color of app.css
  x: readonly Value[];
  y: readonly Value[]; // for a band its lower edge, for cells the levels of y
  upper?: readonly Value[];
  dash?: number[];
  width?: number;
  alpha?: number;
  size?: number; // for points, CSS pixels
  shape?: 'square' | 'ring' | 'cross' | 'star';
  labels?: readonly string[];
  opens?: boolean; // true: its points can be opened
  isQuiet?: boolean; // true: absent from the key, not probed
  cells?: { values: readonly (readonly Value[])[]; paint: (value: number) => string };
}

/** Maps values to pixels of the canvas; NaN for values without a position. */
export interface Place {
  x: (value: Value | undefined) => number;
  y: (value: Value | undefined) => number;
  left: number;
  top: number;
  width: number;
  height: number;
  ratio: number; // pixels of the canvas per CSS pixel
  xIsLog: boolean;
  yIsLog: boolean;
}

type Draw = (context: CanvasRenderingContext2D, mark: Mark, place: Place) => void;

function trace(context: CanvasRenderingContext2D, mark: Mark, place: Place): void {
  let isDown = false;
  for (let k = 0; k < mark.x.length; ++k) {
    const x = place.x(mark.x[k]);
    const y = place.y(mark.y[k]);
    if (Number.isNaN(x) || Number.isNaN(y)) {
      isDown = false;
      continue;
    }
    if (isDown) context.lineTo(x, y);
    else context.moveTo(x, y);
    isDown = true;
  }
}

/** A corner at each change of the value: the best of thousands of trials changes some ten times. */
function traceSteps(context: CanvasRenderingContext2D, mark: Mark, place: Place): void {
  let [end, level] = [NaN, NaN];
  for (let k = 0; k <= mark.x.length; ++k) {
    const x = place.x(mark.x[k]);
    const y = place.y(mark.y[k]);
    const isThere = !Number.isNaN(x) && !Number.isNaN(y);
    if (y !== level) {
      if (!Number.isNaN(level)) context.lineTo(isThere ? x : end, level);
      if (isThere && Number.isNaN(level)) context.moveTo(x, y);
      else if (isThere) context.lineTo(x, y);
    }
    [end, level] = isThere ? [x, y] : [NaN, NaN];
  }
}

const line: Draw = (context, mark, place) => {
  context.lineWidth = (mark.width ?? 1.75) * place.ratio;
  context.lineJoin = 'round';
  context.setLineDash((mark.dash ?? []).map((part) => part * place.ratio));
  context.beginPath();
  if (mark.kind === 'steps') traceSteps(context, mark, place);
  else trace(context, mark, place);
  context.stroke();
  context.setLineDash([]);
};

const points: Draw = (context, mark, place) => {
  const size = (mark.size ?? 4) * place.ratio;
  if (mark.shape && mark.shape !== 'square') {
    drawShapes(context, mark, place, size);
    return;
  }
  const side = Math.max(Math.round(size), 1); // whole pixels are crisp and need no blending
  for (let k = 0; k < mark.x.length; ++k) {
    const x = place.x(mark.x[k]);
    const y = place.y(mark.y[k]);
    if (x >= place.left && y >= place.top - size) context.fillRect(Math.round(x - side / 2), Math.round(y - side / 2), side, side);
  }
};

function drawShapes(context: CanvasRenderingContext2D, mark: Mark, place: Place, size: number): void {
  context.lineWidth = 1.75 * place.ratio;
  for (let k = 0; k < mark.x.length; ++k) {
    const x = place.x(mark.x[k]);
    const y = place.y(mark.y[k]);
    if (Number.isNaN(x) || Number.isNaN(y)) continue;
    context.beginPath();
    if (mark.shape === 'ring') context.arc(x, y, size / 2, 0, 2 * Math.PI);
    else if (mark.shape === 'cross') {
      for (const way of [-1, 1]) {
        context.moveTo(x - size / 2, y - (way * size) / 2);
        context.lineTo(x + size / 2, y + (way * size) / 2);
      }
    } else star(context, x, y, size / 2);
    if (mark.shape === 'star') context.fill();
    else context.stroke();
  }
}

function star(context: CanvasRenderingContext2D, x: number, y: number, radius: number): void {
  for (let k = 0; k < 10; ++k) {
    const r = k % 2 === 0 ? radius : radius * 0.45;
    const angle = (k * Math.PI) / 5 - Math.PI / 2;
    context.lineTo(x + r * Math.cos(angle), y + r * Math.sin(angle));
  }
  context.closePath();
}

const band: Draw = (context, mark, place) => {
  const upper = mark.upper ?? [];
  context.globalAlpha = 0.2;
  context.beginPath();
  let isOpen = false;
  const ends: [number, number][] = [];
  for (let k = 0; k < mark.x.length; ++k) {
    const x = place.x(mark.x[k]);
    const lower = place.y(mark.y[k]);
    const above = place.y(upper[k]);
    if (Number.isNaN(x) || Number.isNaN(lower) || Number.isNaN(above)) continue;
    if (isOpen) context.lineTo(x, above);
    else context.moveTo(x, above);
    isOpen = true;
    ends.push([x, lower]);
  }
  for (const [x, y] of ends.reverse()) context.lineTo(x, y);
  context.closePath();
  context.fill();
  context.globalAlpha = 1;
};

/** Boundaries of the cells of levels: halfway to the neighbors. */
export function edges(levels: readonly Value[], isLog: boolean): number[] {
  const at = levels.map((level) => (isLog ? Math.log(level ?? NaN) : (level ?? NaN)));
  if (at.length === 1) at.push(at[0]! + 1);
  const inner = at.slice(1).map((level, k) => (level + at[k]!) / 2);
  const all = [at[0]! - (inner[0]! - at[0]!), ...inner, at.at(-1)! + (at.at(-1)! - inner.at(-1)!)];
  return isLog ? all.map(Math.exp) : all;
}

const cells: Draw = (context, mark, place) => {
  if (!mark.cells) return;
  const across = edges(mark.x, place.xIsLog).map((value) => Math.round(place.x(value)));
  const along = edges(mark.y, place.yIsLog).map((value) => Math.round(place.y(value)));
  for (let i = 0; i < mark.x.length; ++i) {
    for (let j = 0; j < mark.y.length; ++j) {
      const value = mark.cells.values[i]?.[j];
      if (value === null || value === undefined) continue;
      context.fillStyle = mark.cells.paint(value);
      context.fillRect(across[i]!, along[j + 1]!, across[i + 1]! - across[i]!, along[j]! - along[j + 1]!);
    }
  }
};

const edge: Draw = (context, mark, place) => {
  const [width, height] = [1.5 * place.ratio, 9 * place.ratio];
  for (const value of mark.x) {
    const x = place.x(value);
    if (x >= place.left) context.fillRect(x - width / 2, place.top + place.height - height, width, height);
  }
};

const vertical: Draw = (context, mark, place) => {
  context.lineWidth = 1.25 * place.ratio;
  context.setLineDash((mark.dash ?? [4, 3]).map((part) => part * place.ratio));
  context.beginPath();
  for (const value of mark.x) {
    const x = place.x(value);
    if (Number.isNaN(x)) continue;
    context.moveTo(x, place.top);
    context.lineTo(x, place.top + place.height);
  }
  context.stroke();
  context.setLineDash([]);
};

const horizontal: Draw = (context, mark, place) => {
  context.lineWidth = place.ratio;
  context.setLineDash([2 * place.ratio, 3 * place.ratio]);
  context.beginPath();
  for (const value of mark.y) {
    const y = place.y(value);
    context.moveTo(place.left, y);
    context.lineTo(place.left + place.width, y);
  }
  context.stroke();
  context.setLineDash([]);
};

const stems: Draw = (context, mark, place) => {
  const zero = place.y(0);
  const width = Math.max((mark.width ?? 2) * place.ratio, 1);
  for (let k = 0; k < mark.x.length; ++k) {
    const x = place.x(mark.x[k]);
    const y = place.y(mark.y[k]);
    if (!Number.isNaN(x) && !Number.isNaN(y)) context.fillRect(x - width / 2, Math.min(y, zero), width, Math.abs(y - zero));
  }
};

const kDraw: Record<Mark['kind'], Draw> = { line, steps: line, points, band, cells, edge, vertical, horizontal, stems };

export function drawMark(context: CanvasRenderingContext2D, mark: Mark, place: Place, color: string): void {
  context.strokeStyle = color;
  context.fillStyle = color;
  context.globalAlpha = mark.alpha ?? 1;
  kDraw[mark.kind](context, mark, place);
  context.globalAlpha = 1;
  if (!mark.labels) return;
  context.font = `600 ${12 * place.ratio}px system-ui, sans-serif`;
  context.textBaseline = 'middle';
  mark.labels.forEach((label, k) => {
    const x = place.x(mark.x[k]);
    const y = place.y(mark.y[k]);
    if (!Number.isNaN(x) && !Number.isNaN(y)) context.fillText(label, x + 8 * place.ratio, y - 8 * place.ratio);
  });
}
