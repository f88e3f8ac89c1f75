// SPDX-License-Identifier: Apache-2.0
#include "correlation/report/page_style.h"

namespace latsch::report {

std::string_view style_sheet() {
  return R"css(
:root { color-scheme: light dark;
  --paper: #ffffff; --panel: #f6f7f9; --ink: #1c2733; --soft: #5b6875; --rule: #d9dee4; --grid: #e7eaee;
  --found: #0072b2; --initial: #9aa5b1; --measured: #d55e00; --warn: #b3400a; --warn-paper: #fdf1e7; }
@media (prefers-color-scheme: dark) { :root {
  --paper: #14191f; --panel: #1b222a; --ink: #e4e9ee; --soft: #9aa7b4; --rule: #36414c; --grid: #28313a;
  --found: #56b4e9; --initial: #6d7985; --measured: #f0934a; --warn: #f0a36a; --warn-paper: #33251a; } }
@media print { :root { color-scheme: light;
  --paper: #ffffff; --panel: #ffffff; --ink: #000000; --soft: #444444; --rule: #bbbbbb; --grid: #e4e4e4;
  --found: #0072b2; --initial: #9aa5b1; --measured: #d55e00; --warn: #b3400a; --warn-paper: #ffffff; }
  section, figure, table, .key { break-inside: avoid; } main { max-width: none; padding: 0; } }
* { box-sizing: border-box; }
body { margin: 0; background: var(--paper); color: var(--ink); font: 15px/1.55 system-ui, "Segoe UI", "Helvetica Neue",
  "DejaVu Sans", sans-serif; font-variant-numeric: tabular-nums; }
main { max-width: 1120px; margin: 0 auto; padding: 44px 32px 64px; }
header { border-bottom: 2px solid var(--ink); padding-bottom: 18px; }
h1 { font-size: 30px; line-height: 1.2; margin: 0 0 6px; font-weight: 650; letter-spacing: -0.01em; }
header p { margin: 0; color: var(--soft); }
h2 { font-size: 20px; font-weight: 650; margin: 52px 0 12px; padding-top: 14px; border-top: 1px solid var(--rule); }
h3 { font-size: 15px; font-weight: 650; margin: 26px 0 6px; }
h3 span { color: var(--soft); font-weight: 400; }
p { max-width: 78ch; } .lead { color: var(--soft); margin-top: 0; }
nav { margin: 14px 0 0; font-size: 13.5px; } nav a { color: var(--soft); margin-right: 16px; text-decoration: none;
  white-space: nowrap; } nav a:hover { color: var(--found); text-decoration: underline; }
@media print { nav { display: none; } }
.key { display: grid; grid-template-columns: repeat(auto-fit, minmax(150px, 1fr)); gap: 1px; margin: 26px 0 0;
  background: var(--rule); border: 1px solid var(--rule); border-radius: 6px; overflow: hidden; }
.key div { background: var(--panel); padding: 14px 16px; } .key b { display: block; font-size: 25px; font-weight: 600;
  line-height: 1.25; } .key span { color: var(--soft); font-size: 13px; } .key i { font-style: normal; display: block;
  color: var(--soft); font-size: 13px; }
.scroll { overflow-x: auto; }
table { border-collapse: collapse; margin: 12px 0; font-size: 14px; min-width: 55%; }
th { text-align: left; font-weight: 600; color: var(--soft); font-size: 12.5px; border-bottom: 1.5px solid var(--ink);
  padding: 5px 18px 5px 0; vertical-align: bottom; }
td { padding: 6px 18px 6px 0; border-bottom: 1px solid var(--rule); vertical-align: top; }
th.n, td.n { text-align: right; white-space: nowrap; } th:last-child, td:last-child { padding-right: 0; }
td.strong { font-weight: 650; }
.flag { color: var(--warn); background: var(--warn-paper); border: 1px solid currentColor; border-radius: 3px;
  padding: 0 6px; font-size: 12px; margin-left: 8px; white-space: nowrap; }
.quiet { color: var(--soft); } .track { display: inline-block; position: relative; width: 120px; height: 10px;
  border-left: 1px solid var(--soft); border-right: 1px solid var(--soft); vertical-align: middle; }
.track::before { content: ""; position: absolute; left: 0; right: 0; top: 4.5px; border-top: 1px solid var(--rule); }
.track u, .track s { position: absolute; top: 0; width: 10px; height: 10px; margin-left: -5px; border-radius: 50%; }
.track u { background: var(--found); } .track s { border: 1.5px solid var(--initial); }
.figures { display: grid; grid-template-columns: repeat(auto-fit, minmax(500px, 1fr)); gap: 12px 28px; }
@media (max-width: 1060px) { .figures { grid-template-columns: 1fr; } }
figure { margin: 12px 0 4px; } figcaption { font-size: 13.5px; color: var(--soft); margin-top: 4px; max-width: 78ch; }
figure > b { font-size: 14.5px; font-weight: 650; } figure > b span { color: var(--soft); font-weight: 400; }
svg { display: block; max-width: 100%; height: auto; } svg text { font-size: 12px; fill: var(--ink); }
svg .note { fill: var(--soft); } svg .title { fill: var(--soft); font-size: 12.5px; } svg .strong { font-weight: 650; }
svg .label, svg .number { font-size: 12.5px; } svg .grid { stroke: var(--grid); } svg .axis, svg .ink { stroke: var(--ink); }
svg line.found, svg polyline.found { stroke: var(--found); stroke-width: 2; } svg .found-dot { fill: var(--found); }
svg line.initial, svg polyline.initial { stroke: var(--initial); stroke-width: 1.6; stroke-dasharray: 6 4; }
svg .measured { fill: var(--paper); stroke: var(--measured); stroke-width: 2; }
svg .found-bar { fill: var(--found); } svg .initial-bar { fill: none; stroke: var(--initial); stroke-dasharray: 3 2; }
svg .trial { fill: var(--initial); } svg .failed { fill: none; stroke: var(--warn); stroke-width: 1.4; }
svg .contour { stroke: #ffffff; stroke-opacity: 0.45; stroke-width: 0.8; } svg .node { fill: #ffffff; fill-opacity: 0.7; }
svg .halo { fill: none; stroke: #000000; stroke-opacity: 0.55; stroke-width: 4.2; }
svg .mark, svg .minimum { fill: none; stroke: #ffffff; stroke-width: 2; } svg .minimum { pointer-events: all; }
svg .lowest { stroke: #ff9d5c; stroke-width: 2.6; }
svg .on-field { fill: #ffffff; font-weight: 650; paint-order: stroke; stroke: #000000; stroke-opacity: 0.6;
  stroke-width: 3px; stroke-linejoin: round; }
svg .element { stroke: var(--paper); stroke-width: 0.7; } svg .cord { stroke-width: 1.7; }
svg .inflated { stroke: var(--ink); stroke-width: 1; stroke-dasharray: 4 3; } svg .ground { stroke: var(--ink); stroke-width: 2; } svg .clamped { fill: var(--ink); }
.modes { display: grid; grid-template-columns: repeat(auto-fill, minmax(236px, 1fr)); gap: 14px; }
.modes figure { margin: 0; } .modes figcaption { text-align: center; margin: 0; color: var(--ink); }
.modes figcaption span { color: var(--soft); } canvas { display: block; width: 100%; touch-action: pan-y; cursor: grab; }
canvas.large { max-width: 760px; aspect-ratio: 19 / 12; } .modes canvas { aspect-ratio: 1; }
.bar { display: flex; align-items: center; gap: 10px; font-size: 13px; color: var(--soft); margin: 4px 0; }
.bar i { flex: 0 0 220px; height: 11px; background: linear-gradient(90deg, #440154, #482475, #414487, #355f8d, #2a788e,
  #21918c, #22a884, #44bf70, #7ad151, #bddf26, #fde725); print-color-adjust: exact; -webkit-print-color-adjust: exact; }
.key div, .track u, .flag { print-color-adjust: exact; -webkit-print-color-adjust: exact; }
footer { margin-top: 56px; padding-top: 12px; border-top: 1px solid var(--rule); color: var(--soft); font-size: 13px; }
)css";
}

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
  const reals = (packed, Kind = Int16Array) => Float32Array.from(integers(packed.data, Kind), k => k * packed.scale);
  const faces = integers(tire.faces, Uint16Array);
  const base = reals(tire.base);
  const stops = [[68,1,84],[72,36,117],[65,68,135],[53,95,141],[42,120,142],[33,145,140],[34,168,132],[68,191,112],
                 [122,209,81],[189,223,38],[253,231,37]];
  const viridis = t => {
    const at = Math.min(Math.max(t, 0), 1) * 10, k = Math.min(Math.floor(at), 9), p = at - k;
    return stops[k].map((c, i) => c * (1 - p) + stops[k + 1][i] * p);
  };
  const lengths = d => {
    const values = new Float32Array(d.length / 3);
    for (let k = 0; k < values.length; ++k) values[k] = Math.hypot(d[3 * k], d[3 * k + 1], d[3 * k + 2]);
    return values;
  };

  class View {
    constructor(canvas) {
      this.canvas = canvas;
      this.yaw = 0.72; this.pitch = canvas.dataset.state === undefined ? 0.3 : 0.12; this.phase = 1;
      const mode = canvas.dataset.mode, state = canvas.dataset.state;
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
        running = true; start = performance.now(); requestAnimationFrame(step);
      });
      this.canvas.addEventListener("pointerleave", () => { running = false; });
    }
    // Camera to the right of the tire, a little ahead of it and above.
    projected(points) {
      const cy = Math.cos(this.yaw), sy = Math.sin(this.yaw), cp = Math.cos(this.pitch), sp = Math.sin(this.pitch);
      const far = 6 * tire.radius, size = this.unit * far, out = new Float32Array(points.length);
      for (let k = 0; k < points.length; k += 3) {
        const x = points[k], y = points[k + 1], z = points[k + 2];
        const across = cy * x - sy * y, ahead = sy * x + cy * y;
        const depth = cp * ahead - sp * z, up = sp * ahead + cp * z;
        const zoom = size / (far + depth);
        out[k] = this.cx + zoom * across; out[k + 1] = this.cy - zoom * up; out[k + 2] = depth;
      }
      return out;
    }
    draw() {
      const c = this.canvas, ratio = Math.max(window.devicePixelRatio || 1, 1.5), box = c.getBoundingClientRect();
      c.width = Math.round(box.width * ratio); c.height = Math.round(box.height * ratio);
      this.unit = 0.43 * Math.min(c.width, c.height) / tire.radius; this.cx = c.width / 2; this.cy = c.height / 2;
      let points = this.points;
      if (this.swing) points = points.map((v, k) => v + this.phase * this.swing[k]);
      const g = c.getContext("2d");
      g.clearRect(0, 0, c.width, c.height);
      if (this.ground) this.drawGround(g);
      const seen = this.projected(points), n = faces.length / 4, order = new Array(n), depth = new Float32Array(n);
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
      const edge = (a, b) => [points[b] - points[a], points[b + 1] - points[a + 1], points[b + 2] - points[a + 2]];
      const p = edge(v[0], v[2]), q = edge(v[1], v[3]);
      const normal = [p[1] * q[2] - p[2] * q[1], p[2] * q[0] - p[0] * q[2], p[0] * q[1] - p[1] * q[0]];
      const size = Math.hypot(...normal) || 1;
      const light = 0.7 + 0.3 * Math.abs(0.35 * normal[0] - 0.6 * normal[1] + 0.72 * normal[2]) / size;
      const value = v.reduce((sum, k) => sum + this.color[k / 3], 0) / 4;
      const rgb = viridis(value / this.highest).map(c => Math.round(c * light));
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
      g.strokeStyle = getComputedStyle(document.documentElement).getPropertyValue("--initial");
      g.lineWidth = 1;
      for (let k = 0; k < seen.length; k += 6) {
        g.beginPath(); g.moveTo(seen[k], seen[k + 1]); g.lineTo(seen[k + 3], seen[k + 4]); g.stroke();
      }
    }
  }
  const views = Array.from(document.querySelectorAll("canvas.tire"), canvas => new View(canvas));
  const again = () => views.forEach(view => view.draw());
  window.addEventListener("resize", again);
  window.addEventListener("beforeprint", again);
  window.matchMedia("(prefers-color-scheme: dark)").addEventListener("change", again);
})();
)js";
}

}  // namespace latsch::report
