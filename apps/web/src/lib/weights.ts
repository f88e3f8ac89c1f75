// SPDX-License-Identifier: Apache-2.0
// Weights that replace those of the study file, in the form of the server and of the address: "force:2,modes:0.5".

export type Weights = Record<string, number>;

export function parseWeights(text: string): Weights {
  const pairs = text.split(',').map((part) => {
    const colon = part.lastIndexOf(':');
    return [part.slice(0, colon), Number(part.slice(colon + 1))] as const;
  });
  return Object.fromEntries(pairs.filter(([name, weight]) => name && Number.isFinite(weight) && weight >= 0));
}

export function formatWeights(weights: Weights): string {
  return Object.entries(weights)
    .map(([name, weight]) => `${name}:${weight}`)
    .join(',');
}
