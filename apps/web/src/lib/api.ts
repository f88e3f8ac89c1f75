// SPDX-License-Identifier: Apache-2.0
// Requests of the page to the server, or, in a report, to the answers contained in the page.

import { bytesOf, heldAnswer, isReport } from './answers';
import type * as Contract from './contract';
import { pending } from './pending.svelte';
import { Problem, problemOf } from './problem';

type Query = Record<string, string | number | undefined>;

const kNotHeld = 'This report does not hold it; `latsch serve` beside the study shows it.';

function addressOf(path: string, query: Query): string {
  const parameters = new URLSearchParams();
  for (const [key, value] of Object.entries(query)) {
    if (value !== undefined && value !== '') parameters.set(key, String(value));
  }
  const words = parameters.toString();
  return `/api/${path}${words ? `?${words}` : ''}`;
}

const early = new Map<string, Promise<Response>>();
const kKept = 5000; // ms after which an unread answer is out of date

async function send(what: string, address: string, options: RequestInit): Promise<Response> {
  const end = pending.begin(what);
  const begun = early.get(address);
  early.delete(address);
  try {
    const response = await (begun ?? fetch(address, { credentials: 'same-origin', ...options }));
    if (!response.ok) throw await problemOf(response, what);
    return response;
  } catch (error) {
    if (error instanceof Problem || (error as Error).name === 'AbortError') throw error;
    throw new Problem(
      `no answer from ${location.host}`,
      'Is `latsch serve` still running? Runs that it started go on without it; start it again and reload.',
      what,
    );
  } finally {
    end();
  }
}

async function ask<T>(what: string, path: string, query: Query, signal?: AbortSignal): Promise<T> {
  if (isReport) {
    const answer = heldAnswer(path, query);
    if (answer === undefined) throw new Problem(`${what} is not in this report`, kNotHeld, what);
    return answer as T;
  }
  const response = await send(what, addressOf(path, query), { signal });
  return (await response.json()) as T;
}

async function tell<T>(what: string, path: string, body: unknown): Promise<T> {
  if (isReport) throw new Problem('a report changes nothing', kNotHeld, what);
  const response = await send(what, addressOf(path, {}), {
    method: 'POST',
    headers: { 'Content-Type': 'application/json' },
    body: JSON.stringify(body),
  });
  return (await response.json()) as T;
}

/** Sends a request in advance, so that its answer is under way while the page gets ready to show it. */
export function askEarly(path: string, query: Query): void {
  if (isReport) return;
  const address = addressOf(path, query);
  const answer = fetch(address, { credentials: 'same-origin' });
  answer.catch(() => {}); // errors are reported to the caller
  early.set(address, answer);
  setTimeout(() => early.delete(address), kKept);
}

export interface Stretch {
  from?: number;
  to?: number;
  most?: number;
}

export const api = {
  home: (signal?: AbortSignal) => ask<Contract.Home>('the list of studies', 'home', {}, signal),
  keys: (signal?: AbortSignal) => ask<Contract.KeysOfTables>('the keys of a study', 'keys', {}, signal),
  study: (study: string, signal?: AbortSignal) => ask<Contract.Study>('the study', 'study', { study }, signal),
  convergence: (study: string, stretch: Stretch, weights: string, signal?: AbortSignal) =>
    ask<Contract.Convergence>('the convergence', 'convergence', { study, ...stretch, weights }, signal),
  trials: (study: string, from: number, count: number, order: string, weights: string, signal?: AbortSignal) =>
    ask<Contract.Trials>('trials', 'trials', { study, from, count, order, weights }, signal),
  trial: (study: string, trial: number, signal?: AbortSignal) =>
    ask<Contract.Trial>(`trial ${trial}`, 'trial', { study, trial }, signal),
  comparison: (study: string, trial: string, signal?: AbortSignal) =>
    ask<Contract.Comparison>('what was measured and simulated', 'comparison', { study, trial }, signal),
  limits: (study: string, trial: string, signal?: AbortSignal) =>
    ask<Contract.Limits>('limits that the model meets', 'limits', { study, trial }, signal),
  target: (study: string, weights: string, signal?: AbortSignal) =>
    ask<Contract.Target>('the target function', 'target', { study, weights }, signal),
  kpis: (study: string, weights: string, signal?: AbortSignal) =>
    ask<Contract.Kpis>('the table of targets', 'kpis', { study, weights }, signal),
  identifiability: (study: string, signal?: AbortSignal) =>
    ask<Contract.Identifiability>('the identifiability', 'identifiability', { study }, signal),
  model: (study: string, signal?: AbortSignal) => ask<Contract.Model>('the model', 'model', { study }, signal),
  section: (study: string, trial: string, signal?: AbortSignal) =>
    ask<Contract.Section | null>('the cross-section', 'section', { study, trial }, signal),
  file: (study: string, signal?: AbortSignal) => ask<Contract.StudyFile>('the study file', 'file', { study }, signal),
  compare: (study: string, other: string, signal?: AbortSignal) =>
    ask<Contract.Compared>('both studies', 'compare', { study, other }, signal),

  async scene(study: string, trial: string, signal?: AbortSignal): Promise<ArrayBuffer> {
    if (isReport) {
      const held = await ask<{ gzip_base64: string }>('the scene', 'scene', { study, trial });
      return bytesOf(held.gzip_base64);
    }
    const response = await send('the scene of the model', addressOf('scene', { study, trial }), { signal });
    return response.arrayBuffer();
  },

  check: (study: string, text: string) => tell<Contract.Check>('the check', 'check', { study, text }),
  save: (study: string, version: string, text: string) =>
    tell<{ version: string }>('saving the file', 'save', { study, version, text }),
  edit: (study: string, version: string, edits: Contract.Edit[]) =>
    tell<Contract.StudyFile>('changing the file', 'edit', { study, version, edits }),
  run: (study: string, verb: Contract.Verb, workers: number | undefined, anew: boolean) =>
    tell<{ started: boolean }>('the start', 'run', { study, verb, workers, anew }),
  stop: (study: string) => tell<{ stopping: boolean }>('the stop', 'stop', { study }),
};
