// SPDX-License-Identifier: Apache-2.0
#include "report/page_style.h"

#include <fmt/format.h>

#include "report/html_text.h"

namespace latsch::report {

std::string page_begin(std::string_view title) {
  return fmt::format(
      "<!DOCTYPE html>\n<html lang=\"en\">\n<head>\n<meta charset=\"utf-8\">\n"
      "<meta name=\"viewport\" content=\"width=device-width, initial-scale=1\">\n"
      "<title>{}</title>\n<style>{}</style>\n</head>\n<body>\n<main>\n",
      escape(title),
      style_sheet());
}

std::string_view style_sheet() {
  return R"css(
:root {
  color-scheme: light dark; --paper: #ffffff; --panel: #f6f7f9; --ink: #1c2733; --soft: #5b6875;
  --rule: #d9dee4; --grid: #e7eaee; --found: #0072b2; --initial: #9aa5b1; --measured: #d55e00;
  --warn: #b3400a; --warn-paper: #fdf1e7;
}
@media (prefers-color-scheme: dark) {
  :root {
    --paper: #14191f; --panel: #1b222a; --ink: #e4e9ee; --soft: #9aa7b4; --rule: #36414c;
    --grid: #28313a; --found: #56b4e9; --initial: #6d7985; --measured: #f0934a; --warn: #f0a36a;
    --warn-paper: #33251a;
  }
}
@media print {
  :root {
    color-scheme: light; --paper: #ffffff; --panel: #ffffff; --ink: #000000; --soft: #444444;
    --rule: #bbbbbb; --grid: #e4e4e4; --found: #0072b2; --initial: #9aa5b1; --measured: #d55e00;
    --warn: #b3400a; --warn-paper: #ffffff;
  }
  section, figure, table, .key { break-inside: avoid; }
  main { max-width: none; padding: 0; }
}
* { box-sizing: border-box; }
body {
  margin: 0; background: var(--paper); color: var(--ink);
  font: 15px/1.55 system-ui, "Segoe UI", "Helvetica Neue", "DejaVu Sans", sans-serif;
  font-variant-numeric: tabular-nums;
}
main { max-width: 1120px; margin: 0 auto; padding: 44px 32px 64px; }
header { border-bottom: 2px solid var(--ink); padding-bottom: 18px; }
h1 {
  font-size: 30px; line-height: 1.2; margin: 0 0 6px; font-weight: 650; letter-spacing: -0.01em;
}
header p { margin: 0; color: var(--soft); }
h2 {
  font-size: 20px; font-weight: 650; margin: 52px 0 12px; padding-top: 14px;
  border-top: 1px solid var(--rule);
}
h3 { font-size: 15px; font-weight: 650; margin: 26px 0 6px; }
h3 span { color: var(--soft); font-weight: 400; }
p { max-width: 78ch; }
.lead { color: var(--soft); margin-top: 0; }
nav { display: flex; flex-wrap: wrap; margin: 14px 0 0; font-size: 13.5px; }
nav a { color: var(--soft); margin-right: 16px; text-decoration: none; white-space: nowrap; }
nav a:hover { color: var(--found); text-decoration: underline; }
@media print {
  nav { display: none; }
}
.key {
  display: grid; grid-template-columns: repeat(auto-fit, minmax(150px, 1fr)); gap: 1px;
  margin: 26px 0 0; background: var(--rule); border: 1px solid var(--rule); border-radius: 6px;
  overflow: hidden;
}
.key div { background: var(--panel); padding: 14px 16px; }
.key b { display: block; font-size: 25px; font-weight: 600; line-height: 1.25; }
.key span { color: var(--soft); font-size: 13px; }
.key i { font-style: normal; display: block; color: var(--soft); font-size: 13px; }
.scroll { overflow-x: auto; }
table { border-collapse: collapse; margin: 12px 0; font-size: 14px; min-width: 55%; }
th {
  text-align: left; font-weight: 600; color: var(--soft); font-size: 12.5px;
  border-bottom: 1.5px solid var(--ink); padding: 5px 18px 5px 0; vertical-align: bottom;
}
td { padding: 6px 18px 6px 0; border-bottom: 1px solid var(--rule); vertical-align: top; }
th.n, td.n { text-align: right; white-space: nowrap; }
th:last-child, td:last-child { padding-right: 0; }
td.strong { font-weight: 650; }
.flag {
  color: var(--warn); background: var(--warn-paper); border: 1px solid currentColor;
  border-radius: 3px; padding: 0 6px; font-size: 12px; margin-left: 8px; white-space: nowrap;
}
.quiet { color: var(--soft); }
.track {
  display: inline-block; position: relative; width: 120px; height: 10px;
  border-left: 1px solid var(--soft); border-right: 1px solid var(--soft); vertical-align: middle;
}
.track::before {
  content: ""; position: absolute; left: 0; right: 0; top: 4.5px;
  border-top: 1px solid var(--rule);
}
.track u, .track s {
  position: absolute; top: 0; width: 10px; height: 10px; margin-left: -5px; border-radius: 50%;
}
.track u { background: var(--found); }
.track s { border: 1.5px solid var(--initial); }
.figures {
  display: grid; grid-template-columns: repeat(auto-fit, minmax(500px, 1fr)); gap: 12px 28px;
}
@media (max-width: 1060px) {
  .figures { grid-template-columns: 1fr; }
}
figure { margin: 12px 0 4px; }
figcaption { font-size: 13.5px; color: var(--soft); margin-top: 4px; max-width: 78ch; }
figure > b { font-size: 14.5px; font-weight: 650; }
figure > b span { color: var(--soft); font-weight: 400; }
svg { display: block; max-width: 100%; height: auto; overflow: visible; }
svg text { font-size: 12px; fill: var(--ink); }
svg .note { fill: var(--soft); }
svg .title { fill: var(--soft); font-size: 12.5px; }
svg .strong { font-weight: 650; }
svg .label, svg .number { font-size: 12.5px; }
svg .grid { stroke: var(--grid); }
svg .axis, svg .ink { stroke: var(--ink); }
svg line.found, svg polyline.found { stroke: var(--found); stroke-width: 2; }
svg polygon.band { fill: var(--found); fill-opacity: 0.22; }
svg line.band { stroke: var(--found); stroke-opacity: 0.3; stroke-width: 7; }
svg .found-dot { fill: var(--found); }
svg line.initial, svg polyline.initial {
  stroke: var(--initial); stroke-width: 1.6; stroke-dasharray: 6 4;
}
svg .measured { fill: var(--paper); stroke: var(--measured); stroke-width: 2; }
svg .of-level { fill: var(--paper); stroke-width: 1.2; }
svg .found-bar { fill: var(--found); }
svg .initial-bar { fill: none; stroke: var(--initial); stroke-dasharray: 3 2; }
svg .warm { fill: var(--measured); }
svg .cold { fill: var(--found); }
svg .limit { stroke: var(--measured); stroke-width: 1.6; }
svg .trial { fill: var(--initial); }
svg .failed { fill: none; stroke: var(--warn); stroke-width: 1.4; }
svg .contour { stroke: #ffffff; stroke-opacity: 0.45; stroke-width: 0.8; }
svg .node { fill: #ffffff; fill-opacity: 0.7; }
svg .halo { fill: none; stroke: #000000; stroke-opacity: 0.55; stroke-width: 4.2; }
svg .mark, svg .minimum { fill: none; stroke: #ffffff; stroke-width: 2; }
svg .minimum { pointer-events: all; }
svg .lowest { stroke: #ff9d5c; stroke-width: 2.6; }
svg .on-field {
  fill: #ffffff; font-weight: 650; paint-order: stroke; stroke: #000000; stroke-opacity: 0.6;
  stroke-width: 3px; stroke-linejoin: round;
}
svg .element { stroke: var(--paper); stroke-width: 0.7; }
svg .cord { stroke-width: 1.7; }
svg .inflated { stroke: var(--ink); stroke-width: 1; stroke-dasharray: 4 3; }
svg .ground { stroke: var(--ink); stroke-width: 2; }
svg .clamped { fill: var(--ink); }
.bar {
  display: grid; grid-template-columns: repeat(3, 1fr); width: 260px; font-size: 13px;
  color: var(--soft); margin: 6px 0;
}
.bar span:nth-of-type(2) { text-align: center; }
.bar span:nth-of-type(3) { text-align: right; }
.bar i {
  grid-column: 1 / 4; height: 11px;
  background: linear-gradient(90deg, #440154, #482475, #414487, #355f8d, #2a788e, #21918c,
    #22a884, #44bf70, #7ad151, #bddf26, #fde725);
  print-color-adjust: exact; -webkit-print-color-adjust: exact;
}
.key div, .track u, .flag { print-color-adjust: exact; -webkit-print-color-adjust: exact; }
footer {
  margin-top: 56px; padding-top: 12px; border-top: 1px solid var(--rule); color: var(--soft);
  font-size: 13px;
}
)css";
}

}  // namespace latsch::report
