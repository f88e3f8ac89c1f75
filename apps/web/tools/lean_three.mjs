// SPDX-License-Identifier: Apache-2.0
// Reduces three.js to what the page draws: meshes and lines with MeshLambertMaterial, MeshBasicMaterial and
// LineBasicMaterial. Its renderer imports the shaders of every material, virtual reality, textures and maps of an
// environment; a bundler cannot know that they are never used. Here shaders that the three materials do not include
// become empty texts, those modules become empty classes, and the other shaders lose comments and blanks: a fifth of
// its size remains. A further material needs an entry in kMaterials; without it its program does not compile, which the
// browser's console reports.

import { readFileSync, readdirSync } from 'node:fs';
import { createRequire } from 'node:module';
import { dirname, join } from 'node:path';

const kMaterials = ['meshbasic', 'meshlambert'];

// Chunks that the renderer prepends to the shader of every material.
const kOfEvery = ['colorspace_pars_fragment', 'tonemapping_pars_fragment'];

const kEmpty = {
  'renderers/webxr/WebXRManager.js': `
    import { EventDispatcher } from '../../core/EventDispatcher.js';
    export class WebXRManager extends EventDispatcher {
      enabled = false; isPresenting = false; cameraAutoUpdate = false;
      setAnimationLoop() {} dispose() {} getCamera() { return null; } hasDepthSensing() { return false; }
      getDepthSensingMesh() { return null; } getEnvironmentBlendMode() {}
    }`,
  'renderers/webgl/WebGLCubeUVMaps.js': 'export function WebGLCubeUVMaps() { this.get = (texture) => texture; this.dispose = () => {}; }',
  'renderers/webgl/WebGLCubeMaps.js': 'export function WebGLCubeMaps() { this.get = (texture) => texture; this.dispose = () => {}; }',
  'renderers/webgl/WebGLTextures.js': 'export function WebGLTextures() { this.resetTextureUnits = () => {}; }',
  'renderers/webgl/WebGLMorphtargets.js': 'export function WebGLMorphtargets() { this.update = () => {}; }',
  'renderers/webgl/WebGLShadowMap.js': 'export function WebGLShadowMap() { this.enabled = false; this.render = () => {}; }',
  'renderers/webgl/WebGLBackground.js': `
    import { Color } from '../../math/Color.js';
    export function WebGLBackground(renderer, cubemaps, cubeuvmaps, state, objects, alpha, premultipliedAlpha) {
      const color = new Color(0x000000);
      const clear = () => state.buffers.color.setClear(0, 0, 0, 0, premultipliedAlpha);
      return {
        getClearColor: () => color, setClearColor: clear, getClearAlpha: () => 0, setClearAlpha: clear, addToRenderList() {},
        render() { clear(); if (renderer.autoClear) renderer.clear(renderer.autoClearColor, renderer.autoClearDepth, renderer.autoClearStencil); },
      };
    }`,
};

const source = join(dirname(createRequire(import.meta.url).resolve('three')), '..', 'src');
const shaders = join(source, 'renderers', 'shaders');

const textOf = (file) => readFileSync(file, 'utf8');

/** Names of the chunks that the materials' shaders include, directly or through other chunks. */
function reached() {
  const found = new Set(kOfEvery);
  const visit = (text) => {
    for (const [, name] of text.matchAll(/#include <(\w+)>/g)) {
      if (found.has(name)) continue;
      found.add(name);
      visit(textOf(join(shaders, 'ShaderChunk', `${name}.glsl.js`)));
    }
  };
  for (const name of readdirSync(join(shaders, 'ShaderLib'))) {
    if (kMaterials.includes(name.replace('.glsl.js', ''))) visit(textOf(join(shaders, 'ShaderLib', name)));
  }
  return found;
}

function short(code) {
  const words = code.replace(/\/\*(?! glsl)[\s\S]*?\*\//g, '').replace(/\/\/[^\n`]*/g, '');
  return words.replace(/[ \t]+/g, ' ').replace(/\n\s+/g, '\n').replace(/ ?([=+\-*/,;(){}<>]) ?/g, (all, sign) => (words.includes('#') && /[<(/]/.test(sign) ? all : sign));
}

export function leanThree() {
  const chunks = reached();
  return {
    name: 'latsch-lean-three',
    enforce: 'pre',
    resolveId: (id) => (id === 'three' ? join(source, 'Three.js') : null),
    load(id) {
      const file = id.split('?')[0];
      if (!file.startsWith(source)) return null;
      const path = file.slice(source.length + 1);
      if (path in kEmpty) return kEmpty[path];
      const shader = /renderers\/shaders\/(ShaderChunk|ShaderLib)\/(\w+)\.glsl\.js$/.exec(path);
      if (!shader) return null;
      const isUsed = shader[1] === 'ShaderChunk' ? chunks.has(shader[2]) : kMaterials.includes(shader[2]);
      if (isUsed) return short(textOf(file));
      return shader[1] === 'ShaderChunk' ? "export default '';" : "export const vertex = '';\nexport const fragment = '';";
    },
  };
}
