// SPDX-License-Identifier: Apache-2.0
// latsch show: what was read from a file, with units, on the terminal or as a page.
#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "base/file.h"
#include "cli/shown_file.h"
#include "cli/verbs.h"
#include "correlation/report/html_text.h"
#include "correlation/report/page_style.h"
#include "correlation/report/svg_plot.h"

namespace latsch::cli {
namespace {

using report::Axis;
using report::escape;

constexpr std::size_t kWidest = 40;     // characters of a column on the terminal
constexpr std::size_t kLongest = 400;   // of a sentence
constexpr std::size_t kCorners = 1500;  // of a curve: more than the picture has pixels

std::size_t characters(const std::string& text) {
  return std::count_if(text.begin(), text.end(), [](char c) { return (c & 0xc0) != 0x80; });
}

/// Cut to the widest column, and without what a terminal would obey.
std::string plain(const std::string& text, std::size_t widest = kWidest) {
  std::string result;
  std::size_t count = 0;
  for (const char c : text) {
    if ((c & 0xc0) != 0x80 && ++count > widest) return result + "...";
    result += static_cast<unsigned char>(c) < 0x20 || c == 0x7f ? '?' : c;
  }
  return result;
}

void print_table(const ShownTable& table) {
  fmt::print("\n{}\n", table.title);
  std::vector<std::size_t> widths;
  for (const std::string& head : table.heads) widths.push_back(characters(head));
  for (const auto& row : table.rows)
    for (std::size_t i = 0; i < row.size(); ++i)
      widths[i] = std::max(widths[i], characters(plain(row[i])));
  const auto print_row = [&](const std::vector<std::string>& row) {
    std::string line;
    for (std::size_t i = 0; i < row.size(); ++i) {
      const std::string cell = plain(row[i]);
      line += "  " + cell + std::string(widths[i] - std::min(widths[i], characters(cell)), ' ');
    }
    line.erase(line.find_last_not_of(' ') + 1);
    fmt::print("{}\n", line);
  };
  print_row(table.heads);
  for (const auto& row : table.rows) print_row(row);
}

/// Smallest and largest of every stretch, so that no peak is lost.
void thin(ShownCurve& curve) {
  if (curve.y.size() <= kCorners) return;
  const std::size_t step = (2 * curve.y.size() + kCorners - 1) / kCorners;
  std::vector<double> x, y;
  for (std::size_t begin = 0; begin < curve.y.size(); begin += step) {
    const std::size_t end = std::min(begin + step, curve.y.size());
    std::size_t low = end, high = end;
    for (std::size_t i = begin; i < end; ++i) {
      if (!std::isfinite(curve.y[i])) continue;
      if (low == end || curve.y[i] < curve.y[low]) low = i;
      if (high == end || curve.y[i] > curve.y[high]) high = i;
    }
    if (low == end) continue;
    for (const std::size_t i : {std::min(low, high), std::max(low, high)}) {
      x.push_back(curve.x[i]);
      y.push_back(curve.y[i]);
    }
  }
  curve.x = std::move(x);
  curve.y = std::move(y);
}

std::string picture(ShownCurve curve) {
  thin(curve);
  std::vector<double> finite_x, finite_y;
  for (std::size_t i = 0; i < std::min(curve.x.size(), curve.y.size()); ++i) {
    if (!std::isfinite(curve.x[i]) || !std::isfinite(curve.y[i])) continue;
    finite_x.push_back(curve.x[i]);
    finite_y.push_back(curve.y[i]);
  }
  if (finite_y.empty()) return fmt::format("<p>{}: no numbers</p>\n", escape(curve.y_title));
  report::Svg svg(640, 240, curve.y_title + " over " + curve.x_title);
  const Axis x = Axis::around(finite_x, 72, 624);
  const Axis y = Axis::around(finite_y, 196, 16);
  draw_frame(svg, x, y, curve.x_title, curve.y_title);
  svg.polyline(points_of(x, y, finite_x, finite_y), "class=\"found\" fill=\"none\"");
  return svg.str() + "\n";
}

std::string page(const std::string& file, const ShownFile& shown) {
  std::string text = fmt::format(
      "<!DOCTYPE html>\n<html lang=\"en\">\n<head>\n<meta charset=\"utf-8\">\n"
      "<meta name=\"viewport\" content=\"width=device-width, initial-scale=1\">\n"
      "<title>{0}</title>\n<style>{1}</style>\n</head>\n<body>\n<main>\n<h1>{0}</h1>\n<p>{2}</p>\n",
      escape(file),
      report::style_sheet(),
      escape(shown.kind));
  for (const std::string& fact : shown.facts) text += "<p>" + escape(fact) + "</p>\n";
  for (const ShownTable& table : shown.tables) {
    text += "<section>\n<h2>" + escape(table.title) + "</h2>\n<table>\n<tr>";
    for (const std::string& head : table.heads) text += "<th>" + escape(head) + "</th>";
    text += "</tr>\n";
    for (const auto& row : table.rows) {
      text += "<tr>";
      for (const std::string& cell : row) text += "<td>" + escape(cell) + "</td>";
      text += "</tr>\n";
    }
    text += "</table>\n</section>\n";
  }
  if (!shown.curves.empty()) text += "<section>\n<h2>Curves</h2>\n";
  for (const ShownCurve& curve : shown.curves) text += picture(curve);
  if (!shown.curves.empty()) text += "</section>\n";
  return text + "</main>\n</body>\n</html>\n";
}

int show(const std::string& file, const std::string& html, const std::string& axes) {
  const ShownFile shown = shown_file(file, axis_convention_of(axes));
  fmt::print("{}\n{}\n", file, shown.kind);
  for (const std::string& fact : shown.facts) fmt::print("  {}\n", plain(fact, kLongest));
  for (const ShownTable& table : shown.tables) print_table(table);
  if (!html.empty()) {
    write_text_file(html, page(file, shown));
    fmt::print("\nwrote {}\n", html);
  }
  return kDone;
}

}  // namespace

void add_show(CommandLine& app, int& exit_code) {
  Verb verb = app.add_subcommand("show", "What was read from a file: units, axes, channels");
  verb.footer(
      "Reads TYDEX (.tdx), tables (.csv), tires (.tir), roads (.crg, .rdf, .toml), decks "
      "(.inp).\n\n"
      "Example:\n  latsch show cornering.tdx --axes sae --html cornering.html");
  auto file = std::make_shared<std::string>();
  auto html = std::make_shared<std::string>();
  verb.add_option("file", *file, "File to look at").required();
  verb.add_option("--html", *html, "Page with tables and curves to write");
  auto axes = std::make_shared<std::string>("iso");
  verb.add_option("--axes", *axes, "Signs the file has: iso, adapted_sae or sae; shown are iso's");
  verb.callback([=, &exit_code] { exit_code = show(*file, *html, *axes); });
}

}  // namespace latsch::cli
