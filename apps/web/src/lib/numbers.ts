// SPDX-License-Identifier: Apache-2.0
// Numbers, units and times as they are read.

import type { Value } from './contract';

const kMinus = '−';
const kNone = '–';

const powers: Record<string, string> = { '0': '⁰', '1': '¹', '2': '²', '3': '³', '4': '⁴', '5': '⁵', '6': '⁶', '7': '⁷', '8': '⁸', '9': '⁹', '-': '⁻' };

function raised(exponent: string): string {
  return [...exponent].map((digit) => powers[digit] ?? digit).join('');
}

/** A number with so many significant digits: 0.0016, 20 400, 3.2·10⁻⁹. */
export function number(value: Value | undefined, digits = 4): string {
  if (value === null || value === undefined || !Number.isFinite(value)) return kNone;
  if (value === 0) return '0';
  const size = Math.abs(value);
  if (size >= 1e6 || size < 1e-4) {
    const [mantissa, exponent] = value.toExponential(Math.max(digits - 2, 1)).split('e');
    return `${mantissa!.replace(/\.?0+$/, '').replace('-', kMinus)}·10${raised(String(Number(exponent)))}`;
  }
  const places = Math.max(0, digits - 1 - Math.floor(Math.log10(size)));
  const text = value.toFixed(Math.min(places, 12));
  const [whole, part] = text.split('.');
  const grouped = whole!.length > 5 ? whole!.replace(/\B(?=(\d{3})+$)/g, ' ') : whole!;
  const rest = part?.replace(/0+$/, '');
  return (rest ? `${grouped}.${rest}` : grouped).replace('-', kMinus);
}

/** A ratio in percent. */
export function percent(ratio: Value | undefined, digits = 3): string {
  return ratio === null || ratio === undefined || !Number.isFinite(ratio) ? kNone : `${number(ratio * 100, digits)} %`;
}

export function count(value: number): string {
  return String(value).replace(/\B(?=(\d{3})+$)/g, ' ');
}

/** N/mm^2 as N/mm², N m as N m. */
export function unit(text: string): string {
  return text.replace(/\^(-?\d+)/g, (_, exponent: string) => raised(exponent)).replaceAll('*', '·');
}

export function quantity(value: Value | undefined, units: string, digits = 4): string {
  const text = number(value, digits);
  return text === kNone || !units || units === '1' ? text : `${text} ${unit(units)}`;
}

export function named(name: string, units: string): string {
  return units && units !== '1' ? `${name} [${unit(units)}]` : name;
}

export function duration(seconds: Value | undefined): string {
  if (seconds === null || seconds === undefined || !Number.isFinite(seconds)) return kNone;
  if (seconds < 1) return `${number(seconds * 1000, 2)} ms`;
  if (seconds < 60) return `${number(seconds, 2)} s`;
  const minutes = Math.round(seconds / 60);
  if (minutes < 60) return `${minutes} min`;
  const hours = Math.floor(minutes / 60);
  if (hours < 48) return `${hours} h ${minutes % 60} min`;
  return `${Math.round(hours / 24)} d`;
}

export function ago(secondsSinceEpoch: number): string {
  const seconds = Date.now() / 1000 - secondsSinceEpoch;
  return seconds < 5 ? 'just now' : `${duration(seconds)} ago`;
}

/** An interval in whatever form it is told: [lower, upper], {lower, upper}, half its width. */
export function interval(told: unknown, units = ''): string {
  const ends = intervalEnds(told);
  if (!ends) return typeof told === 'string' && told ? told : kNone;
  if (ends[0] === null && ends[1] === null) return kNone;
  return `${number(ends[0])} … ${quantity(ends[1], units)}`;
}

export function intervalEnds(told: unknown, middle: Value = null): [Value, Value] | null {
  if (Array.isArray(told) && told.length === 2) return [told[0] as Value, told[1] as Value];
  if (typeof told === 'number' && middle !== null) return [middle - told, middle + told];
  if (told && typeof told === 'object' && 'lower' in told && 'upper' in told) {
    return [told.lower as Value, told.upper as Value];
  }
  return null;
}

/** Words of whatever is told: a text, a list of them, an object of them. */
export function words(told: unknown): string {
  if (told === null || told === undefined) return '';
  if (typeof told === 'number') return number(told);
  if (typeof told !== 'object') return String(told);
  if (Array.isArray(told)) return told.map(words).filter(Boolean).join(', ');
  return Object.entries(told)
    .map(([key, value]) => `${key} ${words(value)}`)
    .join(', ');
}
