// SPDX-License-Identifier: Apache-2.0
#include "report/page_style.h"

namespace latsch::report {

std::string_view viewer_script() {
  return R"js(
(function () {
  "use strict";
  const source = document.getElementById("tire-data");
  if (!source || !source.textContent.trim()) return;
  const tire = JSON.parse(source.textContent);
  const integers = (text, Kind) => {
    const bytes = Uint8Array.from(atob(text), c => c.charCodeAt(0));
    return new Kind(bytes.buffer);
  };
  const reals = (packed, Kind = Int16Array) =>
      Float32Array.from(integers(packed.data, Kind), k => k * packed.scale);
  const faces = integers(tire.faces, Uint16Array);
  const base = reals(tire.base);
  const stops = [
    [68, 1, 84], [72, 36, 117], [65, 68, 135], [53, 95, 141], [42, 120, 142], [33, 145, 140],
    [34, 168, 132], [68, 191, 112], [122, 209, 81], [189, 223, 38], [253, 231, 37]];
  const viridis = t => {
    const at = Math.min(Math.max(t, 0), 1) * 10, k = Math.min(Math.floor(at), 9), p = at - k;
    return stops[k].map((c, i) => c * (1 - p) + stops[k + 1][i] * p);
  };
  const lengths = d => {
    const values = new Float32Array(d.length / 3);
    for (let k = 0; k < values.length; ++k) {
      values[k] = Math.hypot(d[3 * k], d[3 * k + 1], d[3 * k + 2]);
    }
    return values;
  };

  class View {
    constructor(canvas) {
      this.canvas = canvas;
      const {mode, state, yaw, pitch} = canvas.dataset;
      this.yaw = yaw === undefined ? 0.72 : Number(yaw);
      this.pitch = pitch === undefined ? (mode === undefined ? 0.12 : 0.3) : Number(pitch);
      this.phase = 1;
      if (mode !== undefined) {
        this.points = base;
        this.swing = reals(tire.modes[mode], Int8Array);
        this.color = lengths(this.swing);
      } else {
        const s = tire.states[state];
        this.points = reals(s.base);
        this.color = reals(s.color);
        this.ground = s.ground;
      }
      this.highest = Math.max(1e-12, this.color.reduce((a, b) => Math.max(a, b), 0));
      this.turnable();
      if (this.swing) this.swinging();
      this.draw();
    }
    turnable() {
      let from = null;
      const c = this.canvas;
      c.addEventListener("pointerdown", e => { from = e; c.setPointerCapture(e.pointerId); });
      c.addEventListener("pointerup", () => { from = null; });
      c.addEventListener("pointermove", e => {
        if (!from) return;
        this.yaw += 0.01 * (e.clientX - from.clientX);
        this.pitch = Math.min(1.5, Math.max(-1.5, this.pitch + 0.01 * (e.clientY - from.clientY)));
        from = e;
        this.draw();
      });
    }
    swinging() {
      const still = window.matchMedia("(prefers-reduced-motion: reduce)").matches;
      let running = false, start = 0;
      const step = now => {
        this.phase = running ? Math.cos((now - start) / 220) : 1;
        this.draw();
        if (running) requestAnimationFrame(step);
      };
      this.canvas.addEventListener("pointerenter", () => {
        if (still) return;
        running = true;
        start = performance.now();
        requestAnimationFrame(step);
      });
      this.canvas.addEventListener("pointerleave", () => { running = false; });
    }
    // Camera to the right of the tire, a little ahead of it and above.
    projected(points) {
      const cy = Math.cos(this.yaw), sy = Math.sin(this.yaw);
      const cp = Math.cos(this.pitch), sp = Math.sin(this.pitch);
      const far = 6 * tire.radius, size = this.unit * far;
      const out = new Float32Array(points.length);
      for (let k = 0; k < points.length; k += 3) {
        const x = points[k], y = points[k + 1], z = points[k + 2];
        const across = cy * x - sy * y, ahead = sy * x + cy * y;
        const depth = cp * ahead - sp * z, up = sp * ahead + cp * z;
        const zoom = size / (far + depth);
        out[k] = this.cx + zoom * across;
        out[k + 1] = this.cy - zoom * up;
        out[k + 2] = depth;
      }
      return out;
    }
    draw() {
      const c = this.canvas, box = c.getBoundingClientRect();
      const ratio = Math.max(window.devicePixelRatio || 1, 1.5);
      c.width = Math.round(box.width * ratio);
      c.height = Math.round(box.height * ratio);
      this.unit = 0.43 * Math.min(c.width, c.height) / tire.radius;
      this.cx = c.width / 2;
      this.cy = c.height / 2;
      let points = this.points;
      if (this.swing) points = points.map((v, k) => v + this.phase * this.swing[k]);
      const g = c.getContext("2d");
      g.clearRect(0, 0, c.width, c.height);
      if (this.ground) this.drawGround(g);
      const seen = this.projected(points), n = faces.length / 4;
      const order = new Array(n), depth = new Float32Array(n);
      for (let f = 0; f < n; ++f) {
        order[f] = f;
        for (let k = 0; k < 4; ++k) depth[f] += seen[3 * faces[4 * f + k] + 2];
      }
      order.sort((a, b) => depth[b] - depth[a]);
      g.lineJoin = "round"; g.lineWidth = 0.5 * ratio;
      for (const f of order) this.drawFace(g, f, seen, points);
    }
    drawFace(g, f, seen, points) {
      const v = [0, 1, 2, 3].map(k => 3 * faces[4 * f + k]);
      const across = (a, b) => [0, 1, 2].map(i => points[b + i] - points[a + i]);
      const p = across(v[0], v[2]), q = across(v[1], v[3]);
      const nx = p[1] * q[2] - p[2] * q[1];
      const ny = p[2] * q[0] - p[0] * q[2];
      const nz = p[0] * q[1] - p[1] * q[0];
      const facing = Math.abs(0.35 * nx - 0.6 * ny + 0.72 * nz) / (Math.hypot(nx, ny, nz) || 1);
      const light = 0.7 + 0.3 * facing;
      const value = v.reduce((sum, k) => sum + this.color[k / 3], 0) / 4;
      const part = value / this.highest;
      const rgb = viridis(this.swing ? part : Math.sqrt(part)).map(c => Math.round(c * light));
      g.fillStyle = "rgb(" + rgb + ")";
      g.strokeStyle = "rgba(0,0,0,0.22)";
      g.beginPath();
      v.forEach((k, i) => i ? g.lineTo(seen[k], seen[k + 1]) : g.moveTo(seen[k], seen[k + 1]));
      g.closePath(); g.fill(); g.stroke();
    }
    drawGround(g) {
      const r = 1.05 * tire.radius, lines = [];
      for (let k = -4; k <= 4; ++k) {
        lines.push(-r, k * r / 8, -this.ground, r, k * r / 8, -this.ground);
        lines.push(k * r / 4, -r / 2, -this.ground, k * r / 4, r / 2, -this.ground);
      }
      const seen = this.projected(lines);
      const style = getComputedStyle(document.documentElement);
      g.strokeStyle = style.getPropertyValue("--initial");
      g.lineWidth = 1;
      for (let k = 0; k < seen.length; k += 6) {
        g.beginPath();
        g.moveTo(seen[k], seen[k + 1]);
        g.lineTo(seen[k + 3], seen[k + 4]);
        g.stroke();
      }
    }
  }
  const canvases = document.querySelectorAll("canvas.tire");
  const views = Array.from(canvases, canvas => new View(canvas));
  document.documentElement.dataset.views = views.length;  // for tests: all drawn
  const again = () => views.forEach(view => view.draw());
  window.addEventListener("resize", again);
  window.addEventListener("beforeprint", again);
  window.matchMedia("(prefers-color-scheme: dark)").addEventListener("change", again);
})();
)js";
}

}  // namespace latsch::report
