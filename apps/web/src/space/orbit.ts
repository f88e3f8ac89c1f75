// SPDX-License-Identifier: Apache-2.0
// A camera that orbits a point, z up: drag rotates, right or shift drag moves, the wheel zooms; arrow keys rotate, +
// and - zoom, 0 shows all.

import type { Camera } from './camera';
import { plus, type Vector } from './vectors';

const kTurn = 0.008; // rad per pixel
const kKeyTurn = 0.12; // rad per key press

export class Orbit {
  #target: Vector = [0, 0, 0];
  #distance = 3;
  #azimuth = -0.9;
  #height = 0.5;
  #home = { target: [0, 0, 0] as Vector, distance: 3, azimuth: -0.9, height: 0.5 };
  #ends: (() => void)[] = [];

  constructor(
    readonly camera: Camera,
    readonly element: HTMLElement,
    readonly onchange: () => void,
  ) {
    this.#listen('pointerdown', (event) => this.#grab(event));
    this.#listen('wheel', (event) => {
      event.preventDefault();
      this.#nearer(Math.exp(Math.sign(event.deltaY) * 0.12));
    });
    this.#listen('keydown', (event) => this.#key(event));
    this.#listen('contextmenu', (event) => event.preventDefault());
  }

  /** Shows everything within `radius` around `center` from this side; key "0" returns to this view. */
  show(center: Vector, radius: number, azimuth = -0.9, height = 0.45): void {
    const distance = (1.1 * radius) / this.camera.sine;
    this.#home = { target: center, distance, azimuth, height };
    this.camera.setReach(distance / 100, distance * 20);
    this.home();
  }

  home(): void {
    this.#target = this.#home.target;
    this.#distance = this.#home.distance;
    this.#azimuth = this.#home.azimuth;
    this.#height = this.#home.height;
    this.#place();
  }

  destroy(): void {
    for (const end of this.#ends) end();
  }

  #listen<K extends keyof HTMLElementEventMap>(kind: K, act: (event: HTMLElementEventMap[K]) => void): void {
    this.element.addEventListener(kind, act, { passive: false });
    this.#ends.push(() => this.element.removeEventListener(kind, act));
  }

  #grab(event: PointerEvent): void {
    let [x, y] = [event.clientX, event.clientY];
    const moves = event.button === 2 || event.shiftKey;
    this.element.setPointerCapture(event.pointerId);
    const move = (next: PointerEvent) => {
      const [dx, dy] = [next.clientX - x, next.clientY - y];
      [x, y] = [next.clientX, next.clientY];
      if (moves) this.#move(dx, dy);
      else this.#turn(-dx * kTurn, dy * kTurn);
    };
    const end = () => {
      this.element.removeEventListener('pointermove', move);
      this.element.removeEventListener('pointerup', end);
      this.element.removeEventListener('pointercancel', end);
    };
    this.element.addEventListener('pointermove', move);
    this.element.addEventListener('pointerup', end);
    this.element.addEventListener('pointercancel', end);
  }

  #key(event: KeyboardEvent): void {
    const acts: Record<string, () => void> = {
      ArrowLeft: () => this.#turn(-kKeyTurn, 0),
      ArrowRight: () => this.#turn(kKeyTurn, 0),
      ArrowUp: () => this.#turn(0, kKeyTurn),
      ArrowDown: () => this.#turn(0, -kKeyTurn),
      '+': () => this.#nearer(0.88),
      '-': () => this.#nearer(1.14),
      '0': () => this.home(),
    };
    const act = acts[event.key];
    if (!act) return;
    event.preventDefault();
    act();
  }

  #turn(azimuth: number, height: number): void {
    this.#azimuth += azimuth;
    this.#height = Math.min(Math.max(this.#height + height, -1.5), 1.5);
    this.#place();
  }

  #nearer(factor: number): void {
    this.#distance *= factor;
    this.#place();
  }

  #move(dx: number, dy: number): void {
    const size = (2 * this.#distance * this.camera.tangent) / this.element.clientHeight;
    this.#target = plus(plus(this.#target, this.camera.right, -dx * size), this.camera.up, dy * size);
    this.#place();
  }

  #place(): void {
    const flat = this.#distance * Math.cos(this.#height);
    const from: Vector = [flat * Math.cos(this.#azimuth), flat * Math.sin(this.#azimuth), this.#distance * Math.sin(this.#height)];
    this.camera.look(plus(this.#target, from), this.#target);
    this.onchange();
  }
}
