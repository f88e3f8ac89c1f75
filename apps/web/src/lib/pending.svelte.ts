// SPDX-License-Identifier: Apache-2.0
// What is being waited for: the line at the foot of the page says it.

import { untrack } from 'svelte';

export interface Waiting {
  what: string;
  since: number;
}

class Pending {
  list = $state.raw<Waiting[]>([]);

  begin(what: string): () => void {
    const entry = { what, since: Date.now() };
    this.list = [...untrack(() => this.list), entry]; // who asks does not depend on who else waits
    return () => {
      this.list = this.list.filter((other) => other !== entry);
    };
  }
}

export const pending = new Pending();
