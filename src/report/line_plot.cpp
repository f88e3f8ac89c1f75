// SPDX-License-Identifier: Apache-2.0
#include "report/line_plot.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "report/color_map.h"
#include "report/svg_plot.h"

namespace latsch::report {
namespace {

// largest number of corners of a line; more are not visible
constexpr std::size_t kLineCorners = 1500;
constexpr double kLeft = 86.0, kTop = 34.0, kRight = 14.0, kBottom = 46.0;  // pixels
constexpr double kLegendRow = 18.0, kDot = 1.4;

/// Returns the positions at which the names in the legend begin; the legend has as many rows as
/// necessary.
std::vector<Point> legend_places(const std::vector<PlotLine>& lines, double width) {
  constexpr double kLetter = 6.6, kGap = 44.0;  // pixels
  std::vector<Point> places;
  Point at(kLeft, 16.0);
  for (const PlotLine& line : lines) {
    const double needed =
        line.name.empty() ? 0.0 : kGap + kLetter * static_cast<double>(line.name.size());
    if (at.x() > kLeft && at.x() + needed > width) at = {kLeft, at.y() + kLegendRow};
    places.push_back(at);
    at.x() += needed;
  }
  return places;
}

/// Divides the line into equal stretches and keeps the least and the greatest value of each, so
/// that no peak is lost.
PlotLine thinned(const PlotLine& line) {
  const std::size_t count = std::min(line.x.size(), line.y.size());
  if (count <= kLineCorners) return line;
  PlotLine thin{line.name, {}, {}, line.color, {}, line.are_dots};
  thin.is_dashed = line.is_dashed;
  const std::size_t stretches = kLineCorners / 2;
  for (std::size_t s = 0; s < stretches; ++s) {
    const std::size_t first = s * count / stretches, end = (s + 1) * count / stretches;
    std::size_t low = first, high = first;
    // A NaN is chosen only if this part of the line has no other value.
    for (std::size_t k = first; k < end; ++k) {
      if (std::isnan(line.y[low]) || line.y[k] < line.y[low]) low = k;
      if (std::isnan(line.y[high]) || line.y[k] > line.y[high]) high = k;
    }
    for (const std::size_t k : {std::min(low, high), std::max(low, high)}) {
      thin.x.push_back(line.x[k]);
      thin.y.push_back(line.y[k]);
      if (!line.spread.empty()) thin.spread.push_back(line.spread[k]);
      if (line.lower.empty()) continue;
      thin.lower.push_back(line.lower[k]);
      thin.upper.push_back(line.upper[k]);
    }
  }
  return thin;
}

void hide_what_has_no_logarithm(PlotLine& line) {
  for (double& value : line.y) {
    if (!(value > 0.0)) value = std::nan("");
  }
}

void gather(const std::vector<double>& from, std::vector<double>& all) {
  std::copy_if(
      from.begin(), from.end(), std::back_inserter(all), [](double v) { return std::isfinite(v); });
}

/// Edges of the frame, px.
struct Frame {
  double left, right, top, bottom;
};

void draw_spread(Svg& svg, const Axis& x, const Axis& y, const PlotLine& line) {
  if (line.spread.empty() && line.lower.empty()) return;
  const bool is_even = line.lower.empty();
  std::vector<Point> outline;
  for (std::size_t k = 0; k < line.x.size(); ++k) {
    outline.emplace_back(x.at(line.x[k]),
                         y.at(is_even ? line.y[k] + line.spread[k] : line.upper[k]));
  }
  for (std::size_t k = line.x.size(); k-- > 0;) {
    outline.emplace_back(x.at(line.x[k]),
                         y.at(is_even ? line.y[k] - line.spread[k] : line.lower[k]));
  }
  svg.polygon(outline, fmt::format("fill=\"{}\" fill-opacity=\"0.25\"", category(line.color)));
}

/// Shades the part of the frame that lies outside of the range of the data.
void shade_outside(Svg& svg,
                   const Axis& x,
                   const std::optional<std::pair<double, double>>& data,
                   const Frame& frame) {
  if (!data) return;
  const auto shade = [&](double from, double to) {
    if (to > from)
      svg.rectangle({from, frame.top},
                    to - from,
                    frame.bottom - frame.top,
                    "fill=\"#8a8a8a\" fill-opacity=\"0.16\" class=\"outside\"",
                    "outside of the data");
  };
  const auto inside = [&](double at) { return std::clamp(at, frame.left, frame.right); };
  if (!(data->second > data->first)) return shade(frame.left, frame.right);
  shade(frame.left, inside(x.at(data->first)));
  shade(inside(x.at(data->second)), frame.right);
}

}  // namespace

std::string line_plot(const LinePlot& plot) {
  std::vector<PlotLine> lines;
  std::vector<double> xs, ys;
  for (const PlotLine& line : plot.lines) {
    lines.push_back(thinned(line));
    if (plot.logarithmic_y) hide_what_has_no_logarithm(lines.back());
    gather(lines.back().x, xs);
    gather(lines.back().y, ys);
    gather(lines.back().lower, ys);
    gather(lines.back().upper, ys);
    for (std::size_t k = 0; k < lines.back().spread.size(); ++k) {
      ys.push_back(lines.back().y[k] + lines.back().spread[k]);
      ys.push_back(lines.back().y[k] - lines.back().spread[k]);
    }
  }
  if (xs.empty() || ys.empty()) return "";
  const auto legend = legend_places(lines, plot.width);
  // Height, px, of the legend's rows beyond the first.
  const double more = legend.back().y() - legend.front().y();
  const double top = kTop + more, bottom = plot.height + more - kBottom;
  const auto [lowest, highest] = std::minmax_element(xs.begin(), xs.end());
  const Axis x(*lowest, *highest, kLeft, plot.width - kRight);
  const Axis y = plot.logarithmic_y ? Axis::logarithmic_around(ys, bottom, top)
                                    : Axis::around(ys, bottom, top);
  Svg svg(plot.width, plot.height + more, plot.description);
  shade_outside(svg, x, plot.data, {kLeft, plot.width - kRight, top, bottom});
  draw_frame(svg, x, y, plot.x_title, plot.y_title);
  for (std::size_t k = 0; k < lines.size(); ++k) {
    const PlotLine& line = lines[k];
    draw_spread(svg, x, y, line);
    const auto stroke = fmt::format("stroke=\"{}\" stroke-width=\"1.6\"{}",
                                    category(line.color),
                                    line.is_dashed ? " stroke-dasharray=\"6 4\"" : "");
    const auto points = points_of(x, y, line.x, line.y);
    if (line.are_dots) {
      const auto fill = fmt::format("fill=\"{}\"", category(line.color));
      for (const Point& point : points) svg.circle(point, kDot, fill);
    } else {
      svg.polyline(points, stroke);
    }
    if (line.name.empty()) continue;
    const Point& at = legend[k];
    svg.line({at.x(), at.y()}, {at.x() + 18.0, at.y()}, stroke);
    svg.text({at.x() + 24.0, at.y() + 4.0}, line.name);
  }
  return svg.str();
}

}  // namespace latsch::report
