// SPDX-License-Identifier: Apache-2.0
// A plot: axes, grid, cursor and selection are those of uPlot; marks.ts draws the marks into its canvas. Dragging
// zooms, a double click shows all; the point nearest to the cursor is passed to the `probe` callback. On a logarithmic
// axis uPlot receives decimal logarithms: its own logarithmic axes show whole decades.

import uPlot from 'uplot';

import type { Value } from '../lib/contract';
import { number } from '../lib/numbers';
import { color } from '../lib/theme.svelte';
import { drawMark, type Mark, type Place } from './marks';
import { fullRange, type Range } from './ranges';
import { logTicks } from './ticks';

export interface Axis {
  title: string;
  isLog?: boolean;
  withZero?: boolean;
  range?: Range;
  isWhole?: boolean; // counts: no ticks between integers
  ticks?: (value: number) => string;
}

export interface Probed {
  mark: Mark;
  index: number;
}

export interface Zoom {
  x: Range;
  y: Range | null;
}

export interface ChartOptions {
  x: Axis;
  y: Axis;
  height: number;
  marks: readonly Mark[];
  onprobe: (probed: Probed | null) => void;
  onzoom: (zoom: Zoom | null) => void;
}

const kWhole = [1, 2, 5, 10, 20, 50, 100, 200, 500, 1e3, 2e3, 5e3, 1e4, 2e4, 5e4, 1e5, 2e5, 5e5, 1e6];
const kReach = 30; // CSS pixels, greatest distance of the cursor from a probed point

export class Chart {
  #plot: uPlot;
  #options: ChartOptions;
  #zoom: Zoom | null = null;
  #dot: HTMLElement;
  #probed: Probed | null = null;

  constructor(host: HTMLElement, width: number, options: ChartOptions) {
    this.#options = options;
    this.#plot = new uPlot(this.#settings(width), [[0, 1], [null, null]], host);
    this.#dot = document.createElement('div');
    this.#dot.className = 'probe-dot';
    this.#plot.over.append(this.#dot);
    this.#range();
  }

  /** Draws other marks in the same axes and keeps the zoom. */
  draw(marks: readonly Mark[]): void {
    if (marks === this.#options.marks) return;
    this.#options.marks = marks;
    this.probe(null);
    this.#range();
  }

  redraw(): void {
    this.#plot.redraw(false, true);
  }

  resize(width: number): void {
    this.#plot.setSize({ width, height: this.#options.height });
  }

  showAll(): void {
    this.#zoom = null;
    this.#range();
    this.#options.onzoom(null);
  }

  destroy(): void {
    this.#plot.destroy();
  }

  /** Moves the probe along the marks by keys: by -1 or 1 to a neighbor, beginning with the last mark that has points. */
  step(by: number): void {
    const marks = this.#options.marks.filter((mark) => !mark.isQuiet && mark.kind !== 'cells' && mark.x.length > 0);
    const mark = this.#probed?.mark ?? marks.find((other) => other.opens) ?? marks.at(-1);
    if (!mark) return;
    const from = this.#probed?.index ?? (by > 0 ? -1 : mark.x.length);
    this.probe({ mark, index: Math.min(Math.max(from + by, 0), mark.x.length - 1) });
  }

  probe(probed: Probed | null): void {
    this.#probed = probed;
    const place = this.#place();
    const x = probed ? (place.x(probed.mark.x[probed.index]) - place.left) / place.ratio : NaN;
    const y = probed ? (place.y(probed.mark.y[probed.index]) - place.top) / place.ratio : NaN;
    const isSeen = Number.isFinite(x) && Number.isFinite(y) && probed?.mark.kind !== 'edge';
    this.#dot.hidden = !isSeen;
    if (isSeen) this.#dot.style.transform = `translate(${x}px, ${y}px)`;
    this.#options.onprobe(probed);
  }

  #range(): void {
    const { x, y, marks } = this.#options;
    const across = this.#zoom?.x ?? x.range ?? fullRange(marks, 'x', !!x.isLog, false);
    const along = this.#zoom?.y ?? y.range ?? fullRange(marks, 'y', !!y.isLog, !!y.withZero);
    this.#plot.batch(() => {
      this.#plot.setScale('x', inScale(across, x.isLog));
      this.#plot.setScale('y', inScale(along, y.isLog));
      this.#plot.redraw(false, true);
    });
  }

  #settings(width: number): uPlot.Options {
    const { x, y, height } = this.#options;
    return {
      width,
      height,
      padding: [10, 14, 0, 0],
      legend: { show: false },
      scales: { x: { time: false, auto: false }, y: { auto: false } },
      axes: [this.#axis(x, false), this.#axis(y, true)],
      series: [{}, { show: true }],
      cursor: {
        points: { show: false },
        drag: { x: true, y: true, uni: 20, setScale: false },
        bind: {
          dblclick: () => () => {
            this.showAll();
            return null;
          },
        },
      },
      hooks: {
        draw: [() => this.#draw()],
        setCursor: [() => this.#follow()],
        setSelect: [() => this.#select()],
      },
    };
  }

  #axis(axis: Axis, isUpright: boolean): uPlot.Axis {
    const ticks = axis.ticks ?? ((value: number) => number(value));
    return {
      label: axis.title,
      labelSize: 20,
      labelGap: 0,
      size: isUpright ? (_, values) => Math.max(58, 14 + 7.4 * Math.max(...(values ?? []).map((value) => value.length))) : 27,
      gap: 5,
      ...(isUpright && this.#options.height < 160 ? { space: 16 } : {}),
      ...(isUpright || axis.isLog ? {} : { space: (_: uPlot, __: number, least: number, greatest: number) => labelRoom(ticks, least, greatest) }),
      ...(axis.isWhole ? { incrs: kWhole } : {}),
      ...(axis.isLog ? { splits: (plot: uPlot, _: number, least: number, greatest: number) => logTicks(least, greatest, room(plot, isUpright)) } : {}),
      stroke: () => color('--soft'),
      font: '12px system-ui, "DejaVu Sans", sans-serif',
      labelFont: '12px system-ui, "DejaVu Sans", sans-serif',
      grid: { stroke: () => color('--grid'), width: 1 },
      ticks: { stroke: () => color('--grid'), width: 1, size: 5 },
      values: (_, splits) => splits.map((value) => (value === null ? '' : ticks(axis.isLog ? 10 ** value : value))),
    };
  }

  #place(): Place {
    const { left, top, width, height } = this.#plot.bbox;
    const way = (key: 'x' | 'y', isLog: boolean | undefined, from: number, over: number) => {
      const { min: least = 0, max: greatest = 1 } = this.#plot.scales[key]!;
      const slope = over / (greatest! - least!);
      return (value: Value | undefined): number => {
        if (value === null || value === undefined) return NaN;
        if (isLog) return value > 0 ? from + (Math.log10(value) - least!) * slope : NaN;
        return from + (value - least!) * slope;
      };
    };
    const { x, y } = this.#options;
    return {
      x: way('x', x.isLog, left, width),
      y: way('y', y.isLog, top + height, -height),
      left, top, width, height,
      ratio: devicePixelRatio || 1,
      xIsLog: !!x.isLog,
      yIsLog: !!y.isLog,
    };
  }

  #draw(): void {
    const context = this.#plot.ctx;
    const place = this.#place();
    context.save();
    context.beginPath();
    context.rect(place.left, place.top, place.width, place.height);
    context.clip();
    for (const mark of this.#options.marks) drawMark(context, mark, place, color(mark.color));
    context.restore();
  }

  #follow(): void {
    const { left = -1, top = -1 } = this.#plot.cursor;
    if (left < 0 || top < 0) {
      this.probe(null);
      return;
    }
    const place = this.#place();
    const [atX, atY] = [left * place.ratio + place.left, top * place.ratio + place.top];
    this.probe(nearest(this.#options.marks, place, atX, atY, kReach * place.ratio));
  }

  #select(): void {
    const { left, top, width, height } = this.#plot.select;
    if (width < 4 && height < 4) return;
    const ends = (key: 'x' | 'y', from: number, over: number): Range => {
      const [a, b] = [this.#value(from, key), this.#value(from + over, key)];
      return a < b ? [a, b] : [b, a];
    };
    const inner = this.#plot.over;
    const x = width >= 4 && width < inner.clientWidth ? ends('x', left, width) : this.#shown('x');
    const y = height >= 4 && height < inner.clientHeight ? ends('y', top, height) : (this.#zoom?.y ?? null);
    this.#plot.setSelect({ left: 0, top: 0, width: 0, height: 0 }, false);
    this.#zoom = { x, y };
    this.#range();
    this.#options.onzoom(this.#zoom);
  }

  #shown(key: 'x' | 'y'): Range {
    const { min, max } = this.#plot.scales[key]!;
    return this.#options[key].isLog ? [10 ** min!, 10 ** max!] : [min!, max!];
  }

  #value(position: number, key: 'x' | 'y'): number {
    const value = this.#plot.posToVal(position, key);
    return this.#options[key].isLog ? 10 ** value : value;
  }
}

/** Number of ticks that fit. */
function room(plot: uPlot, isUpright: boolean): number {
  const [length, each] = isUpright ? [plot.bbox.height, 26] : [plot.bbox.width, 52];
  return Math.max(Math.floor(length / devicePixelRatio / each), 3);
}

function inScale([least, greatest]: Range, isLog: boolean | undefined): { min: number; max: number } {
  return isLog ? { min: Math.log10(least), max: Math.log10(greatest) } : { min: least, max: greatest };
}

/** The nearest point within reach; for cells the one below the cursor. Marks drawn later come first. */
/** CSS pixels between ticks of a horizontal axis, so that the longest label fits with a gap. */
function labelRoom(ticks: (value: number) => string, least: number, greatest: number): number {
  const step = 10 ** Math.floor(Math.log10(Math.max((greatest - least) / 5, Number.MIN_VALUE)));
  const labels = [least, greatest].map((value) => ticks(Math.round(value / step) * step));
  return Math.max(50, 16 + 7.4 * Math.max(...labels.map((label) => label.length)));
}

function nearest(marks: readonly Mark[], place: Place, atX: number, atY: number, reach: number): Probed | null {
  let best: Probed | null = null;
  let least = reach * reach;
  for (const mark of [...marks].reverse()) {
    if (mark.isQuiet || mark.kind === 'cells' || mark.kind === 'vertical' || mark.kind === 'horizontal') continue;
    for (let k = 0; k < mark.x.length; ++k) {
      const dx = place.x(mark.x[k]) - atX;
      if (!(Math.abs(dx) <= reach)) continue;
      const dy = mark.kind === 'edge' ? Math.max(place.top + place.height - 12 - atY, 0) : place.y(mark.y[k]) - atY;
      const square = dx * dx + dy * dy;
      if (square < least) {
        least = square;
        best = { mark, index: k };
      }
    }
  }
  if (best) return best;
  const grid = marks.find((mark) => mark.kind === 'cells');
  return grid ? { mark: grid, index: cellAt(grid, place, atX, atY) } : null;
}

function cellAt(grid: Mark, place: Place, atX: number, atY: number): number {
  const closest = (levels: readonly Value[], at: number, to: (value: Value) => number) =>
    levels.reduce<number>((best, level, k) => (Math.abs(to(level) - at) < Math.abs(to(levels[best] ?? null) - at) ? k : best), 0);
  return closest(grid.x, atX, place.x) * grid.y.length + closest(grid.y, atY, place.y);
}
