// SPDX-License-Identifier: Apache-2.0
// The study file while it is edited: the text on the disk, the edited text, the messages of the program about it. The
// form and the text change the same file; if another program has changed it meanwhile, nothing is overwritten without
// asking.

import { api } from '../../lib/api';
import type { Check, Edit } from '../../lib/contract';
import { asProblem, type Problem } from '../../lib/problem';
import type { OpenStudy } from '../../lib/study.svelte';

const kPause = 350; // ms after the last key until the text is checked

export class EditedFile {
  text = $state('');
  check = $state.raw<Check | null>(null);
  problem = $state.raw<Problem | null>(null);
  isChecking = $state(false);
  isBusy = $state(false);
  isReady = $state(false);
  hasConflict = $state(false);
  #onDisk = $state('');
  #before: string[] = $state.raw([]); // earlier texts, before changes by the form or Save; the latest is last
  #version = '';
  #timer: ReturnType<typeof setTimeout> | undefined;
  #question = 0;

  constructor(readonly open: OpenStudy) {}

  get isChanged(): boolean {
    return this.text !== this.#onDisk;
  }

  /** True if a change written from here can be undone. */
  get canUndo(): boolean {
    return this.#before.length > 0 && !this.isChanged;
  }

  /** Restores the file before the last change from here; a change by another program in between is a conflict. */
  async undo(): Promise<void> {
    const text = this.#before.at(-1);
    if (text === undefined) return;
    await this.#try('taking the change back', async () => {
      const { version } = await api.save(this.open.name, this.#version, text);
      this.#before = this.#before.slice(0, -1);
      this.#take(text, version);
      await this.open.read();
    });
  }

  async read(): Promise<void> {
    await this.#try('reading the study file', async () => {
      const file = await api.file(this.open.name);
      this.#take(file.text, file.version);
      this.isReady = true;
    });
  }

  type(text: string): void {
    this.text = text;
    clearTimeout(this.#timer);
    this.#timer = setTimeout(() => void this.#ask(), kPause);
  }

  discard(): void {
    this.text = this.#onDisk;
    this.hasConflict = false;
    void this.#ask();
  }

  async save(): Promise<void> {
    await this.#try('saving the study file', async () => {
      const { version } = await api.save(this.open.name, this.#version, this.text);
      this.#before = [...this.#before, this.#onDisk];
      this.#onDisk = this.text;
      this.#version = version;
      this.hasConflict = false;
      await this.open.read();
    });
  }

  /** Makes one change from the form; only if there is no unsaved text. */
  async edit(edits: Edit[]): Promise<void> {
    await this.#try('changing the study file', async () => {
      const file = await api.edit(this.open.name, this.#version, edits);
      this.#before = [...this.#before, this.#onDisk];
      this.#take(file.text, file.version);
      await this.open.read();
    });
  }

  /** Replaces the edited text by the file on the disk. */
  async takeTheirs(): Promise<void> {
    this.hasConflict = false;
    await this.read();
  }

  /** Writes the edited text over the changes of another program. */
  async keepMine(): Promise<void> {
    const mine = this.text;
    await this.#try('reading the study file', async () => {
      const file = await api.file(this.open.name);
      this.#onDisk = file.text;
      this.#version = file.version;
      this.text = mine;
    });
    if (!this.problem) await this.save();
  }

  /** Reads the file, which may have changed: replaces the text if it is unchanged, else reports a conflict. */
  async look(): Promise<void> {
    if (this.isBusy || !this.isReady) return;
    try {
      const file = await api.file(this.open.name);
      if (file.version === this.#version) return;
      if (this.isChanged) this.hasConflict = true;
      else {
        this.#before = []; // they belong to another file
        this.#take(file.text, file.version);
      }
    } catch {
      // The foot of the page reports that the server is not reachable.
    }
  }

  end(): void {
    clearTimeout(this.#timer);
  }

  #take(text: string, version: string): void {
    this.text = text;
    this.#onDisk = text;
    this.#version = version;
    void this.#ask();
  }

  async #try(what: string, act: () => Promise<void>): Promise<void> {
    this.isBusy = true;
    this.problem = null;
    try {
      await act();
    } catch (error) {
      const problem = asProblem(error, what);
      if (problem.status === 409) this.hasConflict = true;
      else this.problem = problem;
    }
    this.isBusy = false;
  }

  async #ask(): Promise<void> {
    const mine = ++this.#question;
    this.isChecking = true;
    try {
      const check = await api.check(this.open.name, this.text);
      if (mine === this.#question) this.check = check;
    } catch (error) {
      if (mine === this.#question) this.problem = asProblem(error, 'the check');
    }
    if (mine === this.#question) this.isChecking = false;
  }
}
