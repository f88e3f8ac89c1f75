// SPDX-License-Identifier: Apache-2.0
// The drawing of things in space against closed forms: places and rays of the camera, what the probe hits, the brightness
// of a diffuse surface.

import assert from 'node:assert/strict';
import { dirname, join } from 'node:path';
import { fileURLToPath } from 'node:url';

import { build } from 'vite';

import { newPage } from './browser.mjs';

const sources = join(dirname(fileURLToPath(import.meta.url)), '..', 'src', 'space');

/** The modules as one script, of which `names` are the exports. */
async function script(names) {
  const name = '\0space';
  const text = names.map((one) => `export * from '${join(sources, one)}.ts';`).join('\n');
  const entry = { name: 'latsch-space', enforce: 'pre', resolveId: (id) => (id.endsWith('modules-of-space') ? name : null), load: (id) => (id === name ? text : null) };
  const made = await build({ configFile: false, logLevel: 'silent', plugins: [entry], build: { write: false, minify: false, target: 'es2022', lib: { entry: 'modules-of-space', formats: ['es'] } } });
  return `data:text/javascript;base64,${Buffer.from(made[0].output[0].code).toString('base64')}`;
}

const space = await import(await script(['vectors', 'camera', 'picking', 'shapes']));

const near = (a, b, most = 1e-6) => a.forEach((x, k) => assert.ok(Math.abs(x - b[k]) <= most, `${a} is not ${b}`)); // points of meshes are float32

function camera() {
  const made = new space.Camera();
  made.aspect = 1.6;
  made.look([3, -4, 2], [0.5, 0.2, -0.1]);
  return made;
}

const quad = (corners, extra = {}) => ({
  kind: 'solid', at: [0, 0, 0], center: [0, 0, 0], opacity: 1, points: { data: new Float32Array(corners.flat()), version: 0 }, triangles: new Uint32Array([0, 1, 2, 0, 2, 3]),
  normals: null, colors: null, parts: [{ first: 0, count: 6, color: [0.2, 0.5, 0.05] }], hasBack: true, isLit: true, behind: 0, isVeil: false, ...extra,
});
const square = [[-1, -1, 0], [1, -1, 0], [1, 1, 0], [-1, 1, 0]];
const rod = (a, b, radius) => ({ kind: 'rods', at: [0, 0, 0], center: [0, 0, 0], opacity: 1, shape: space.cylinder(8), ends: { data: new Float32Array([...a, ...b, radius]), version: 0 }, colors: { data: new Float32Array(3), version: 0 } });

export const claims = {
  'the ray through the picture of a point passes through the point'() {
    const from = camera();
    for (const point of [[0, 0, 0], [1, -1, 0.5], [-0.4, 0.7, -1]]) {
      const { from: eye, along } = from.ray(...from.project(point));
      const to = space.minus(point, eye);
      near(space.times(along, space.length(to)), to);
    }
    near(from.project([0.5, 0.2, -0.1]), [0, 0]);
    assert.equal(from.project(space.plus(from.eye, from.back)), null, 'a point behind the eye has no place');
  },

  'the probe hits a plane where the ray meets it, on the nearest corner, and the nearer of two'() {
    const ray = { from: [0.3, -0.2, 5], along: [0, 0, -1] };
    const [low, high] = [quad(square), quad(square, { at: [0, 0, 1] })];
    const found = space.hit([low, high], ray);
    assert.equal(found.object, high);
    near(found.point, [0.3, -0.2, 1]);
    assert.equal(found.nearest, 1);
    const tilted = space.hit([quad(square.map(([x, y]) => [x, y, x]))], ray);
    near(tilted.point, [0.3, -0.2, 0.3]);
    assert.equal(space.hit([quad(square, { parts: [] })], ray), null, 'hidden parts are not hit');
    assert.equal(space.hit([quad(square)], { ...ray, along: [0, 0, 1] }), null, 'what is behind the eye is not hit');
  },

  'the probe hits a rod on its surface, within its radius and its length'() {
    const ray = (x, y) => ({ from: [x, y, 5], along: [0, 0, -1] });
    const one = rod([-1, 0, 0], [1, 0, 0], 0.1);
    near(space.hit([one], ray(0.5, 0.06)).point, [0.5, 0.06, 0.08]); // 0.1^2 = 0.06^2 + 0.08^2
    assert.equal(space.hit([one], ray(0.5, 0.11)), null);
    assert.equal(space.hit([one], ray(1.2, 0)), null);
    assert.equal(space.hit([rod([0, 0, 0], [0, 0, 0], 0.1)], ray(0, 0)), null, 'a rod without length is not drawn');
    near(space.hit([rod([0, 0, -1], [0, 0, 0], 0.1)], ray(0, 0)).point, [0, 0, -0.9], 0.1 + 1e-6); // along the ray
  },

  'shapes are closed: each edge has a triangle on both sides, and they face outwards'() {
    for (const [name, shape] of Object.entries({ cylinder: space.cylinder(8), cone: space.cone(12), ball: space.ball(1, 20, 14) })) {
      let volume = 0;
      const edges = new Map();
      const key = (k) => [0, 1, 2].map((axis) => (Math.round(1e4 * shape.points[3 * k + axis]) + 0).toFixed()).join(' ');
      for (let at = 0; at < shape.triangles.length; at += 3) {
        const corners = [...shape.triangles.subarray(at, at + 3)];
        const [a, b, c] = corners.map((k) => space.pointOf(shape.points, k));
        volume += space.dot(a, space.cross(b, c)) / 6;
        const keys = corners.map(key);
        if (new Set(keys).size < 3) continue; // at a pole
        keys.forEach((from, k) => {
          const [way, back] = [`${from} - ${keys[(k + 1) % 3]}`, `${keys[(k + 1) % 3]} - ${from}`];
          if (edges.get(back)) edges.set(back, edges.get(back) - 1);
          else edges.set(way, (edges.get(way) ?? 0) + 1);
        });
      }
      assert.deepEqual([...edges].filter(([, count]) => count), [], `${name} has open edges`);
      const polygon = (n) => (n / 2) * Math.sin((2 * Math.PI) / n); // the area of a base
      const exact = { cylinder: polygon(8), cone: polygon(12) / 3, ball: (4 * Math.PI) / 3 }[name];
      assert.ok(Math.abs(volume / exact - 1) < (name === 'ball' ? 0.04 : 1e-5), `${name}: volume ${volume} is not ${exact}`); // a ball of 20 x 14 facets lacks 3.3 %
    }
  },

  async 'a diffuse surface has the brightness of Lambert\'s law, and sides that are not seen are not drawn'({ browser }) {
    const page = await newPage(browser);
    const code = await script(['vectors', 'camera', 'renderer', 'shapes']);
    const read = (solid, eye, things) =>
      page.evaluate(async ([from, one, where, more]) => {
        const { Camera, Renderer } = await import(from);
        const camera = new Camera();
        camera.look(where, [0, 0, 0]);
        const renderer = new Renderer(() => {});
        renderer.resize(40, 40, 1);
        const revived = [one, ...more].map((thing) => ({ ...thing, points: { data: new Float32Array(thing.points.data), version: 0 }, triangles: new Uint32Array(thing.triangles) }));
        renderer.draw(revived, camera);
        const gl = renderer.canvas.getContext('webgl2');
        const pixel = new Uint8Array(4);
        gl.readPixels(20, 20, 1, 1, gl.RGBA, gl.UNSIGNED_BYTE, pixel);
        renderer.destroy();
        return [...pixel];
      }, [code, plain(solid), eye, (things ?? []).map(plain)]);
    const plain = (solid) => ({ ...solid, points: { data: [...solid.points.data] }, triangles: [...solid.triangles] });
    const srgb = (x) => 255 * (x <= 0.0031308 ? 12.92 * x : 1.055 * x ** (1 / 2.4) - 0.055);
    const brightness = (eye) => {
      const seen = camera();
      seen.look(eye, [0, 0, 0]);
      const lamp = space.unit(space.plus(eye, space.plus(space.plus(space.times(seen.right, 0.4), seen.up, -0.3), seen.back)));
      return (2.1 + 1.1 * Math.abs(lamp[2])) / Math.PI;
    };
    for (const eye of [[0.01, 0, 5], [2, -3, 2], [1, 2, -4]]) {
      const shade = brightness(eye);
      near(await read(quad(square), eye), [...[0.2, 0.5, 0.05].map((x) => srgb(x * shade)), 255], 1.01); // one step of a byte
    }
    near(await read(quad(square, { isLit: false }), [2, -3, 2]), [...[0.2, 0.5, 0.05].map(srgb), 255], 1.01);
    assert.deepEqual(await read(quad(square, { hasBack: false }), [1, 2, -4]), [0, 0, 0, 0]);
    // A veil of half the opacity before a surface, whichever is given first, mixes the bytes of both.
    const veil = quad(square, { at: [0, 0, 1], opacity: 0.5, isLit: false, isVeil: true, parts: [{ first: 0, count: 6, color: [1, 1, 1] }] });
    const below = quad(square, { isLit: false });
    near((await read(veil, [0.01, 0, 5], [below])).slice(0, 3), [0.2, 0.5, 0.05].map((x) => (srgb(x) + 255) / 2), 1.51); // two roundings
    assert.deepEqual(page.errors, []);
    await page.context().close();
  },
};
