// SPDX-License-Identifier: Apache-2.0
// The requests that are pending; the line at the foot of the page shows them.

import { untrack } from 'svelte';

export interface Waiting {
  what: string;
  since: number;
}

class Pending {
  list = $state.raw<Waiting[]>([]);

  begin(what: string): () => void {
    const entry = { what, since: Date.now() };
    this.list = [...untrack(() => this.list), entry]; // the caller must not depend on other pending requests
    return () => {
      this.list = this.list.filter((other) => other !== entry);
    };
  }
}

export const pending = new Pending();
