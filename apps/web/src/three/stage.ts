// SPDX-License-Identifier: Apache-2.0
// A stage for objects in space: renderer, camera, light, labels, a probe. It is drawn when something has changed, or in
// every frame of the screen while something moves.

import { AmbientLight, DirectionalLight, type Mesh, type Object3D, PerspectiveCamera, Raycaster, Scene, Vector2, Vector3, WebGLRenderer } from 'three';

import { Orbit } from './orbit';

export interface Label {
  text: string;
  at: [number, number, number];
  isStrong?: boolean;
}

export interface Hit {
  object: Object3D;
  point: Vector3;
  corners: [number, number, number]; // indices of the triangle's points
  nearest: number;
  instance: number | undefined; // for instanced meshes
}

export class Stage {
  readonly scene = new Scene();
  readonly camera = new PerspectiveCamera(32, 1, 0.01, 100);
  readonly orbit: Orbit;
  #renderer: WebGLRenderer;
  #labels: { label: Label; element: HTMLElement }[] = [];
  #observer: ResizeObserver;
  #isDue = false;
  #move: ((seconds: number) => void) | null = null;

  /** Throws if the browser has no WebGL. */
  constructor(
    readonly host: HTMLElement,
    onprobe: (x: number, y: number) => void,
  ) {
    this.#renderer = new WebGLRenderer({ antialias: true, alpha: true });
    this.#renderer.setPixelRatio(Math.min(devicePixelRatio, 2));
    host.append(this.#renderer.domElement);
    const light = new DirectionalLight('#ffffff', 1.1);
    light.position.set(0.4, -0.3, 1);
    this.camera.add(light);
    this.scene.add(this.camera, new AmbientLight('#ffffff', 2.1));
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

  /** The nearest of these objects below a point of the picture. */
  hit(objects: readonly Mesh[], x: number, y: number): Hit | null {
    const ray = new Raycaster();
    ray.setFromCamera(new Vector2(x, y), this.camera);
    const found = ray.intersectObjects([...objects], false)[0];
    if (!found?.face) return null;
    const object = found.object as Mesh;
    const corners: Hit['corners'] = [found.face.a, found.face.b, found.face.c];
    const places = object.geometry.getAttribute('position');
    const local = object.worldToLocal(found.point.clone());
    const distance = (k: number) => new Vector3().fromBufferAttribute(places, k).distanceToSquared(local);
    const nearest = corners.reduce((best, k) => (distance(k) < distance(best) ? k : best));
    return { object, point: found.point, corners, nearest, instance: found.instanceId };
  }

  clear(objects: readonly Object3D[]): void {
    for (const object of objects) {
      this.scene.remove(object);
      const { geometry, material } = object as Mesh;
      geometry?.dispose();
      for (const one of Array.isArray(material) ? material : [material]) one?.dispose();
    }
  }

  destroy(): void {
    this.#move = null;
    this.#observer.disconnect();
    this.orbit.destroy();
    this.setLabels([]);
    this.#renderer.dispose();
    this.#renderer.forceContextLoss();
    this.#renderer.domElement.remove();
  }

  #resize(): void {
    const { clientWidth: width, clientHeight: height } = this.host;
    if (!width || !height) return;
    this.#renderer.setSize(width, height);
    this.camera.aspect = width / height;
    this.camera.updateProjectionMatrix();
    this.request();
  }

  #draw(): void {
    this.#renderer.render(this.scene, this.camera);
    const place = new Vector3();
    for (const { label, element } of this.#labels) {
      place.set(...label.at).project(this.camera);
      const x = ((place.x + 1) / 2) * this.host.clientWidth;
      const y = ((1 - place.y) / 2) * this.host.clientHeight;
      element.hidden = place.z > 1;
      element.style.transform = `translate(${x}px, ${y}px) translate(-50%, -50%)`;
    }
  }
}
