// SPDX-License-Identifier: Apache-2.0
// One answer for display: the present one stays while the next is requested, and only the last request counts.

import { asProblem, type Problem } from './problem';

export class Resource<T> {
  value = $state.raw<T | null>(null);
  problem = $state.raw<Problem | null>(null);
  isLoading = $state(false);
  #current: AbortController | null = null;

  constructor(readonly what: string) {}

  async load(ask: (signal: AbortSignal) => Promise<T>): Promise<void> {
    this.#current?.abort();
    const mine = new AbortController();
    this.#current = mine;
    this.isLoading = true;
    try {
      const value = await ask(mine.signal);
      if (this.#current !== mine) return;
      this.value = value;
      this.problem = null;
    } catch (error) {
      if (this.#current !== mine) return;
      this.problem = asProblem(error, this.what);
    }
    this.isLoading = false;
  }

  forget(): void {
    this.#current?.abort();
    this.#current = null;
    this.value = null;
    this.problem = null;
    this.isLoading = false;
  }
}
