// SPDX-License-Identifier: Apache-2.0
// Numbers, units and times as shown to people.

import type { Told, Value } from './contract';

const kMinus = '−';
const kNone = '–';

const powers: Record<string, string> = { '0': '⁰', '1': '¹', '2': '²', '3': '³', '4': '⁴', '5': '⁵', '6': '⁶', '7': '⁷', '8': '⁸', '9': '⁹', '-': '⁻' };

function raised(exponent: string): string {
  return [...exponent].map((digit) => powers[digit] ?? digit).join('');
}

/** A number with that many significant digits: 0.0016, 20 400, 3.2·10⁻⁹. */
export function number(value: Value | undefined, digits = 4): string {
  if (value === null || value === undefined || !Number.isFinite(value)) return kNone;
  if (value === 0) return '0';
  const size = Math.abs(value);
  if (size >= 1e6 || size < 1e-4) {
    const [mantissa, exponent] = value.toExponential(Math.max(digits - 2, 1)).split('e');
    const power = `10${raised(String(Number(exponent)))}`;
    const short = mantissa!.replace(/\.?0+$/, '').replace('-', kMinus);
    return short === '1' ? power : `${short}·${power}`;
  }
  const places = Math.max(0, digits - 1 - Math.floor(Math.log10(size)));
  const text = value.toFixed(Math.min(places, 12));
  const [whole, part] = text.split('.');
  const grouped = whole!.replace('-', '').length > 5 ? whole!.replace(/\B(?=(\d{3})+$)/g, ' ') : whole!;
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

/** Typesets a unit: N/mm^2 as N/mm², N m as N m. */
export function unit(text: string): string {
  if (text === '1') return '';
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
  if (hours < 10) return `${hours} h ${minutes % 60} min`;
  return hours < 48 ? `${hours} h` : `${Math.round(hours / 24)} d`;
}

export function ago(secondsSinceEpoch: number): string {
  const seconds = Date.now() / 1000 - secondsSinceEpoch;
  return seconds < 5 ? 'just now' : `${duration(seconds)} ago`;
}

/** Typesets the numbers of a text: -0.3 as −0.3, 1.1e-05 as 1.1·10⁻⁵. */
export function typeset(text: string): string {
  return text
    .replace(/(\d)e([+-]?)0*(\d+)/g, (_, digit: string, sign: string, exponent: string) => `${digit}·10${raised(sign.replace('+', '') + exponent)}`)
    .replace(/(^|[\s(±…])-(?=[\d.])/g, `$1${kMinus}`);
}

/** A text of the program, in which names stand between backticks, for a page: `NFX` as “NFX”. */
export const quoted = (text: string): string => text.replace(/`([^`\n]+)`/g, '“$1”');

/** A number, or a text that the program has worded already. */
export function told(what: Told | undefined, units = ''): string {
  if (typeof what === 'string') return what ? unit(typeset(what.replace(' .. ', ' … ').replaceAll('+- ', '± '))) : kNone;
  if (Array.isArray(what)) return what.every((end) => end === null) ? kNone : `${number(what[0])} … ${quantity(what[1], units)}`;
  return quantity(what as Value | undefined, units);
}

/** Ends of an interval, from [lower, upper], "9.8 .. 10.3 N/mm^2", "at least 9.8 N/mm^2" or "anywhere between the bounds"; null for
 * a missing end. Returns null if the text is no interval. */
export function intervalEnds(what: Told): [Value, Value] | null {
  if (Array.isArray(what)) return [what[0] ?? null, what[1] ?? null];
  if (typeof what !== 'string') return null;
  if (what.startsWith('anywhere')) return [null, null];
  const sides = /^at (least|most) ([^\s,]+)/.exec(what);
  if (sides) return sides[1] === 'least' ? [Number(sides[2]), null] : [null, Number(sides[2])];
  const both = /^(\S+) \.\. (\S+)/.exec(what);
  return both ? [Number(both[1]), Number(both[2])] : null;
}

/** The end of a long path, which distinguishes files. */
export function shortPath(path: string): string {
  const parts = path.split('/');
  return parts.length > 3 ? `…/${parts.slice(-2).join('/')}` : path;
}
