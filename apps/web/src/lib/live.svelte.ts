// SPDX-License-Identifier: Apache-2.0
// The server's events: that it is alive, that a list has changed, that trials have ended. The browser reconnects by
// itself if the connection breaks; the displayed data are then requested anew. A hidden page closes its connection: a
// browser has few connections to one server, and many tabs would use all of them.

import { isReport } from './answers';
import type { RunEvent, TrialEvent } from './contract';

interface Heard {
  home: Record<string, never>;
  trials: TrialEvent;
  run: RunEvent;
  again: Record<string, never>;
}

type Kind = keyof Heard;
type Listener = (data: never) => void;

const kSilence = 6000; // ms; the server sends a sign of life every two seconds

class Live {
  isAlive = $state(isReport);
  lastSeen = $state(Date.now());
  #source: EventSource | null = null;
  #study = '';
  #listeners = new Map<Kind, Set<Listener>>();
  #wasLost = false;

  /** Follows this study's events; "" follows the list alone. */
  follow(study: string): void {
    if (isReport || (this.#source && study === this.#study)) return;
    this.#source?.close();
    this.#source = null;
    this.#study = study;
    if (document.hidden) return; // watch() connects when the page is visible
    const source = new EventSource(study ? `/events?study=${encodeURIComponent(study)}` : '/events');
    this.#source = source;
    source.onopen = () => this.#seen();
    source.onerror = () => {
      this.isAlive = false;
      this.#wasLost = true;
    };
    source.addEventListener('alive', () => this.#seen());
    for (const kind of ['home', 'trials', 'run'] as const) {
      source.addEventListener(kind, (event) => {
        this.#seen();
        this.#tell(kind, JSON.parse((event as MessageEvent<string>).data || '{}'));
      });
    }
  }

  watch(): () => void {
    const look = () => {
      if (isReport) return;
      this.#wasLost = true;
      this.lastSeen = Date.now(); // the silence is measured from here
      if (document.hidden) this.#leave();
      else this.follow(this.#study);
    };
    document.addEventListener('visibilitychange', look);
    const timer = setInterval(() => {
      if (isReport || document.hidden || Date.now() - this.lastSeen < kSilence) return;
      this.isAlive = false;
      this.#wasLost = true;
      if (this.#source?.readyState === EventSource.CLOSED) {
        this.#leave();
        this.follow(this.#study);
      }
    }, 1000);
    return () => {
      clearInterval(timer);
      document.removeEventListener('visibilitychange', look);
    };
  }

  #leave(): void {
    this.#source?.close();
    this.#source = null;
  }

  on<K extends Kind>(kind: K, listener: (data: Heard[K]) => void): () => void {
    const all = this.#listeners.get(kind) ?? new Set<Listener>();
    this.#listeners.set(kind, all);
    all.add(listener as Listener);
    return () => all.delete(listener as Listener);
  }

  #seen(): void {
    this.isAlive = true;
    this.lastSeen = Date.now();
    if (this.#wasLost) {
      this.#wasLost = false;
      this.#tell('again', {});
    }
  }

  #tell(kind: Kind, data: unknown): void {
    for (const listener of this.#listeners.get(kind) ?? []) listener(data as never);
  }
}

export const live = new Live();
