// SPDX-License-Identifier: Apache-2.0
// A stage for things in space: renderer, camera, labels, a probe. It is drawn when something has changed, or in
// every frame of the screen while something moves.

import { Camera } from './camera';
import { Orbit } from './orbit';
import { hit, type Hit } from './picking';
import { Renderer } from './renderer';
import type { Drawn, Rods, Solid } from './things';
import type { Vector } from './vectors';

export interface Label {
  text: string;
  at: Vector;
  isStrong?: boolean;
}

export class Stage {
  readonly camera = new Camera();
  readonly orbit: Orbit;
  #renderer: Renderer;
  #things: Drawn[] = [];
  #labels: { label: Label; element: HTMLElement }[] = [];
  #observer: ResizeObserver;
  #isDue = false;
  #move: ((seconds: number) => void) | null = null;

  /** Throws if the browser has no WebGL. */
  constructor(
    readonly host: HTMLElement,
    onprobe: (x: number, y: number) => void,
  ) {
    this.#renderer = new Renderer(() => this.request());
    host.append(this.#renderer.canvas);
    this.orbit = new Orbit(this.camera, host, () => this.request());
    host.addEventListener('pointermove', (event) => {
      if (event.buttons) return;
      const box = host.getBoundingClientRect();
      onprobe(((event.clientX - box.left) / box.width) * 2 - 1, 1 - ((event.clientY - box.top) / box.height) * 2);
    });
    this.#observer = new ResizeObserver(() => this.#resize());
    this.#observer.observe(host);
  }

  setLabels(labels: readonly Label[]): void {
    for (const { element } of this.#labels) element.remove();
    this.#labels = labels.map((label) => {
      const element = document.createElement('span');
      element.className = label.isStrong ? 'label strong' : 'label';
      element.textContent = label.text;
      this.host.append(element);
      return { label, element };
    });
    this.request();
  }

  /** Requests a drawing in the next frame of the screen. */
  request(): void {
    if (this.#isDue) return;
    this.#isDue = true;
    requestAnimationFrame((now) => {
      this.#isDue = false;
      this.#move?.(now / 1000);
      this.#draw();
      if (this.#move) this.request();
    });
  }

  /** Calls `move` before every frame; null ends it. */
  animate(move: ((seconds: number) => void) | null): void {
    this.#move = move;
    this.request();
  }

  /** The nearest of these things below a point of the picture. */
  hit(objects: readonly (Solid | Rods)[], x: number, y: number): Hit | null {
    return hit(objects, this.camera.ray(x, y));
  }

  add(things: readonly Drawn[]): void {
    this.#things.push(...things);
    this.request();
  }

  clear(things: readonly Drawn[]): void {
    this.#things = this.#things.filter((thing) => !things.includes(thing));
    this.#renderer.forget(things);
  }

  destroy(): void {
    this.#move = null;
    this.#observer.disconnect();
    this.orbit.destroy();
    this.setLabels([]);
    this.#renderer.destroy();
  }

  #resize(): void {
    const { clientWidth: width, clientHeight: height } = this.host;
    if (!width || !height) return;
    this.#renderer.resize(width, height, Math.min(devicePixelRatio, 2));
    this.camera.aspect = width / height;
    this.request();
  }

  #draw(): void {
    this.#renderer.draw(this.#things, this.camera);
    for (const { label, element } of this.#labels) {
      const place = this.camera.project(label.at);
      element.hidden = !place;
      if (!place) continue;
      const x = ((place[0] + 1) / 2) * this.host.clientWidth;
      const y = ((1 - place[1]) / 2) * this.host.clientHeight;
      element.style.transform = `translate(${x}px, ${y}px) translate(-50%, -50%)`;
    }
  }
}
