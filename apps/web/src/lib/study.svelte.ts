// SPDX-License-Identifier: Apache-2.0
// The open study: the data that all its views need. It is read anew when trials have ended, at most once a second.

import { api } from './api';
import type { Study } from './contract';
import { live } from './live.svelte';
import { Resource } from './resource.svelte';

const kPause = 1000; // ms between two readings
const kPatience = 4000; // ms without a message from a run, after which its last lines are requested

export class OpenStudy {
  answer = new Resource<Study>('the study');
  readAt = $state(Date.now());
  #timer: ReturnType<typeof setTimeout> | undefined;
  #last = 0;

  constructor(readonly name: string) {}

  get study(): Study | null {
    return this.answer.value;
  }

  read(): Promise<void> {
    this.#last = Date.now();
    return this.answer.load((signal) => api.study(this.name, signal)).then(() => {
      this.readAt = Date.now();
    });
  }

  /** Follows events until the returned function is called. */
  follow(): () => void {
    live.follow(this.name);
    void this.read();
    const soon = () => {
      if (this.#timer !== undefined) return;
      this.#timer = setTimeout(() => {
        this.#timer = undefined;
        void this.read();
      }, Math.max(0, this.#last + kPause - Date.now()));
    };
    const patience = setInterval(() => {
      const state = this.study?.state;
      if ((state === 'running' || state === 'reading') && Date.now() - this.#last > kPatience) void this.read();
    }, kPatience);
    const ends = [live.on('trials', soon), live.on('run', soon), live.on('home', soon), live.on('again', soon)];
    return () => {
      clearTimeout(this.#timer);
      clearInterval(patience);
      for (const end of ends) end();
    };
  }
}

/** Calls `act` after trials of this study have ended or its file has been read anew, at most once in `pause` ms. */
export function onTrials(study: string, act: () => void, pause = 1000): () => void {
  let timer: ReturnType<typeof setTimeout> | undefined;
  const soon = () => {
    timer ??= setTimeout(() => {
      timer = undefined;
      act();
    }, pause);
  };
  const ends = [
    live.on('trials', (event) => { if (event.study === study) soon(); }),
    live.on('run', (event) => { if (event.study === study) soon(); }),
    live.on('again', soon),
  ];
  return () => {
    clearTimeout(timer);
    for (const end of ends) end();
  };
}
