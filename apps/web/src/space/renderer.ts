// SPDX-License-Identifier: Apache-2.0
// Draws things into a canvas by WebGL 2. What is opaque comes first, in any order; then what lets light through, from the
// farthest to the nearest. If the browser takes the graphics processor away, everything is sent to it again afterwards.

import type { Camera } from './camera';
import { fragmentShader, kPlaces, type Look, vertexShader } from './shaders';
import type { Drawn, Lines, Numbers, Rods, Solid } from './things';
import { dot, plus, unit, type Vector } from './vectors';

type Gl = WebGL2RenderingContext;

const kLamp: Vector = [0.4, -0.3, 1]; // place of the lamp in the camera's frame; it shines at the scene's origin

interface Program {
  program: WebGLProgram;
  uniform: (name: string) => WebGLUniformLocation | null;
}

export class Renderer {
  readonly canvas = document.createElement('canvas');
  #gl: Gl;
  #programs = new Map<string, Program>();
  #numbers = new Map<Numbers, { buffer: WebGLBuffer; version: number }>();
  #arrays = new Map<object, WebGLBuffer>(); // data that never change
  #drawings = new Map<Drawn, WebGLVertexArrayObject>();

  /** `onreturn` is called if everything has to be drawn again. Throws if the browser has no WebGL 2. */
  constructor(onreturn: () => void) {
    const gl = this.canvas.getContext('webgl2', { antialias: true });
    if (!gl) throw new Error('renderer.ts: this browser has no WebGL 2');
    this.#gl = gl;
    this.canvas.addEventListener('webglcontextlost', (event) => event.preventDefault());
    this.canvas.addEventListener('webglcontextrestored', () => {
      for (const kept of [this.#programs, this.#numbers, this.#arrays, this.#drawings]) kept.clear();
      onreturn();
    });
  }

  /** Sizes in CSS pixels, and pixels of the canvas per CSS pixel. */
  resize(width: number, height: number, ratio: number): void {
    this.canvas.width = Math.floor(width * ratio);
    this.canvas.height = Math.floor(height * ratio);
    Object.assign(this.canvas.style, { width: `${width}px`, height: `${height}px` });
  }

  draw(things: readonly Drawn[], camera: Camera): void {
    const gl = this.#gl;
    gl.viewport(0, 0, this.canvas.width, this.canvas.height);
    gl.depthMask(true);
    gl.clearColor(0, 0, 0, 0);
    gl.clear(gl.COLOR_BUFFER_BIT | gl.DEPTH_BUFFER_BIT);
    gl.enable(gl.DEPTH_TEST);
    gl.depthFunc(gl.LEQUAL);
    gl.blendFuncSeparate(gl.SRC_ALPHA, gl.ONE_MINUS_SRC_ALPHA, gl.ONE, gl.ONE_MINUS_SRC_ALPHA);
    const clear = things.filter((thing) => thing.opacity < 1);
    const depth = (thing: Drawn) => camera.depth(plus(thing.center, thing.at));
    for (const thing of things) if (thing.opacity === 1) this.#draw(thing, camera);
    for (const thing of clear.sort((a, b) => depth(b) - depth(a))) this.#draw(thing, camera);
  }

  /** Frees what the things occupy, but not what other things still use. */
  forget(things: readonly Drawn[]): void {
    for (const thing of things) {
      const drawing = this.#drawings.get(thing);
      if (drawing) this.#gl.deleteVertexArray(drawing);
      this.#drawings.delete(thing);
    }
    const used = new Set<object>([...this.#drawings.keys()].flatMap(partsOf));
    const free = (key: object, buffer: WebGLBuffer) => {
      if (used.has(key)) return false;
      this.#gl.deleteBuffer(buffer);
      return true;
    };
    for (const [key, { buffer }] of this.#numbers) if (free(key, buffer)) this.#numbers.delete(key);
    for (const [key, buffer] of this.#arrays) if (free(key, buffer)) this.#arrays.delete(key);
  }

  destroy(): void {
    this.#gl.getExtension('WEBGL_lose_context')?.loseContext();
    this.canvas.remove();
  }

  #draw(thing: Drawn, camera: Camera): void {
    const gl = this.#gl;
    const { program, uniform } = this.#program(lookOf(thing));
    gl.useProgram(program);
    this.#bind(thing);
    const solid = thing.kind === 'solid' ? thing : null;
    const lamp = unit(plus([dot(camera.right, camera.eye), dot(camera.up, camera.eye), dot(camera.back, camera.eye)], kLamp));
    gl.uniformMatrix4fv(uniform('view'), false, camera.view);
    gl.uniformMatrix4fv(uniform('projection'), false, camera.projection);
    gl.uniform3f(uniform('at'), ...thing.at);
    gl.uniform3f(uniform('lamp'), ...lamp);
    gl.uniform1f(uniform('opacity'), thing.opacity);
    turn(gl, gl.BLEND, thing.opacity < 1);
    turn(gl, gl.POLYGON_OFFSET_FILL, !!solid?.behind);
    gl.polygonOffset(solid?.behind ?? 0, solid?.behind ?? 0);
    gl.depthMask(!solid?.isVeil);
    turn(gl, gl.CULL_FACE, !solid?.hasBack);
    gl.cullFace(gl.BACK);
    if (thing.kind === 'rods') {
      gl.drawElementsInstanced(gl.TRIANGLES, thing.shape.triangles.length, gl.UNSIGNED_INT, 0, thing.ends.data.length / 7);
    } else if (thing.kind === 'lines') {
      gl.uniform3f(uniform('color'), ...thing.color);
      if (thing.pairs) gl.drawElements(gl.LINES, thing.pairs.length, gl.UNSIGNED_INT, 0);
      else gl.drawArrays(gl.LINES, 0, thing.points.data.length / 3);
    } else {
      this.#triangles(thing, uniform('color'));
    }
  }

  /** Of a body that lets light through, draws the side behind first. */
  #triangles(solid: Solid, color: WebGLUniformLocation | null): void {
    const gl = this.#gl;
    const draw = ({ first, count }: { first: number; count: number }) => gl.drawElements(gl.TRIANGLES, count, gl.UNSIGNED_INT, 4 * first);
    for (const part of solid.parts) {
      if (!solid.colors) gl.uniform3f(color, ...part.color);
      if (solid.hasBack && solid.opacity < 1) {
        gl.enable(gl.CULL_FACE);
        gl.cullFace(gl.FRONT);
        draw(part);
        gl.cullFace(gl.BACK);
      }
      draw(part);
    }
  }

  #program(look: Look): Program {
    const key = JSON.stringify(look);
    const known = this.#programs.get(key);
    if (known) return known;
    const gl = this.#gl;
    const program = gl.createProgram();
    for (const [kind, text] of [[gl.VERTEX_SHADER, vertexShader(look)], [gl.FRAGMENT_SHADER, fragmentShader(look)]] as const) {
      const shader = gl.createShader(kind)!;
      gl.shaderSource(shader, text);
      gl.compileShader(shader);
      gl.attachShader(program, shader);
      gl.deleteShader(shader); // once the program is
    }
    gl.linkProgram(program);
    if (!gl.getProgramParameter(program, gl.LINK_STATUS) && !gl.isContextLost()) {
      const logs = (gl.getAttachedShaders(program) ?? []).map((shader) => gl.getShaderInfoLog(shader));
      throw new Error(`renderer.ts: a program for the graphics processor failed: ${[gl.getProgramInfoLog(program), ...logs].join(' ')}`);
    }
    const places = new Map<string, WebGLUniformLocation | null>();
    const uniform = (name: string) => {
      if (!places.has(name)) places.set(name, gl.getUniformLocation(program, name));
      return places.get(name)!;
    };
    this.#programs.set(key, { program, uniform });
    return { program, uniform };
  }

  /** Makes the thing's arrays those that are drawn, and sends those that have changed. */
  #bind(thing: Drawn): void {
    const gl = this.#gl;
    const known = this.#drawings.get(thing);
    const drawing = known ?? gl.createVertexArray();
    gl.bindVertexArray(drawing);
    for (const part of partsOf(thing)) if ('version' in part) this.#send(part as Numbers);
    if (known) return;
    this.#drawings.set(thing, drawing);
    if (thing.kind === 'rods') {
      this.#place(kPlaces.point, this.#keep(thing.shape.points, gl.ARRAY_BUFFER), 3);
      this.#place(kPlaces.normal, this.#keep(thing.shape.normals, gl.ARRAY_BUFFER), 3);
      this.#keep(thing.shape.triangles, gl.ELEMENT_ARRAY_BUFFER);
      this.#place(kPlaces.from, this.#send(thing.ends), 3, 28, 0, 1);
      this.#place(kPlaces.to, this.#send(thing.ends), 4, 28, 12, 1);
      this.#place(kPlaces.color, this.#send(thing.colors), 3, 0, 0, 1);
      return;
    }
    this.#place(kPlaces.point, this.#send(thing.points), 3);
    const indices = thing.kind === 'lines' ? thing.pairs : thing.triangles;
    if (indices) this.#keep(indices, gl.ELEMENT_ARRAY_BUFFER);
    if (thing.kind === 'lines') return;
    if (thing.normals) this.#place(kPlaces.normal, this.#send(thing.normals), 3);
    if (thing.colors) this.#place(kPlaces.color, this.#send(thing.colors), 3);
  }

  #place(place: number, buffer: WebGLBuffer, size: number, stride = 0, offset = 0, divisor = 0): void {
    const gl = this.#gl;
    gl.bindBuffer(gl.ARRAY_BUFFER, buffer);
    gl.enableVertexAttribArray(place);
    gl.vertexAttribPointer(place, size, gl.FLOAT, false, stride, offset);
    gl.vertexAttribDivisor(place, divisor);
  }

  #send(numbers: Numbers): WebGLBuffer {
    const gl = this.#gl;
    const known = this.#numbers.get(numbers);
    if (known?.version === numbers.version) return known.buffer;
    const buffer = known?.buffer ?? gl.createBuffer();
    gl.bindBuffer(gl.ARRAY_BUFFER, buffer);
    gl.bufferData(gl.ARRAY_BUFFER, numbers.data, gl.DYNAMIC_DRAW);
    this.#numbers.set(numbers, { buffer, version: numbers.version });
    return buffer;
  }

  #keep(array: Float32Array | Uint32Array, where: number): WebGLBuffer {
    const gl = this.#gl;
    const known = this.#arrays.get(array);
    const buffer = known ?? gl.createBuffer();
    gl.bindBuffer(where, buffer);
    if (!known) gl.bufferData(where, array, gl.STATIC_DRAW);
    this.#arrays.set(array, buffer);
    return buffer;
  }
}

const lookOf = (thing: Drawn): Look => ({
  isRods: thing.kind === 'rods',
  isLit: thing.kind === 'rods' || (thing.kind === 'solid' && thing.isLit),
  isFlat: thing.kind === 'lines' || (thing.kind === 'solid' && !thing.normals),
  hasColors: thing.kind === 'rods' || (thing.kind === 'solid' && !!thing.colors),
});

const arraysOf = {
  rods: ({ ends, colors, shape }: Rods) => [ends, colors, shape.points, shape.normals, shape.triangles],
  lines: ({ points, pairs }: Lines) => [points, pairs],
  solid: ({ points, normals, colors, triangles }: Solid) => [points, normals, colors, triangles],
};

/** Everything of the thing that is in the memory of the graphics processor. */
function partsOf(thing: Drawn): object[] {
  const parts: readonly (object | null)[] = (arraysOf[thing.kind] as (one: Drawn) => (object | null)[])(thing);
  return parts.filter((part) => part !== null);
}

const turn = (gl: Gl, what: number, isOn: boolean) => (isOn ? gl.enable(what) : gl.disable(what));
