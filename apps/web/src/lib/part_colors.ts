// SPDX-License-Identifier: Apache-2.0
// Muted colors of Okabe and Ito for the parts of a model, as in the report: a part has the same color everywhere.

const kColors = ['#8fb3d1', '#e2b48f', '#93c9b4', '#dbb3cb', '#ecd49b', '#b5dcf0', '#bdbdbd'];
const kOwn: readonly [RegExp, string][] = [[/^(road|posts)( |$)/, '#b9c0c7'], [/^tire /, '#8a949e'], [/^chassis$/, '#8fb3d1']];
const places = new Map<string, number>();

export function partColor(part: string): string {
  const own = kOwn.find(([name]) => name.test(part));
  if (own) return own[1];
  const place = places.get(part) ?? places.size;
  places.set(part, place);
  return kColors[place % kColors.length]!;
}
