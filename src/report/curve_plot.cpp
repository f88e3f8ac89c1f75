// SPDX-License-Identifier: Apache-2.0
#include "report/curve_plot.h"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <cmath>
#include <sstream>

#include "report/color_map.h"
#include "report/html_text.h"
#include "report/svg_plot.h"

namespace latsch::report {
namespace {

// largest number of points of a curve that are drawn as dots
constexpr std::size_t kDots = 200;
constexpr std::size_t kCorners = 2000;  // largest number of corners of a line; more are not visible
constexpr double kKeyRow = 18.0;        // px, height of a row of the legend

struct Samples {
  std::vector<double> x, y;  // in the units of the plot
};

/// Returns every k-th sample, with the smallest k for which at most `most` samples remain.
Samples thinned(const Samples& samples, std::size_t most) {
  const std::size_t count = std::min(samples.x.size(), samples.y.size());
  const std::size_t step = std::max<std::size_t>(1, (count + most - 1) / most);
  Samples few;
  for (std::size_t k = 0; k < count; k += step) {
    few.x.push_back(samples.x[k]);
    few.y.push_back(samples.y[k]);
  }
  return few;
}

/// Returns the simulated samples in the units of the plot. A program may have simulated far more
/// than was measured, so samples outside the measured `range` are left out.
Samples shown(const MeasuredCurve& curve,
              const std::vector<double>& x,
              const std::vector<double>& y,
              const Axis* range = nullptr) {
  Samples samples;
  for (std::size_t k = 0; k < y.size(); ++k) {
    double at = static_cast<double>(k + 1);
    if (!curve.x_name.empty()) {
      if (k >= x.size()) break;
      at = in_unit(x[k], curve.x_unit);
    }
    if (range && !(range->lower() <= at && at <= range->upper())) continue;
    samples.x.push_back(at);
    samples.y.push_back(in_unit(y[k], curve.y_unit));
  }
  return samples;
}

/// Returns the samples of one piece of the curve, at the measured abscissas.
Samples piece_of(const MeasuredCurve& curve,
                 const MeasuredCurve::Piece& piece,
                 const std::vector<double>& y) {
  if (y.size() < piece.end) return {};
  const auto part = [&](const std::vector<double>& all) {
    return std::vector<double>(all.begin() + static_cast<std::ptrdiff_t>(piece.from),
                               all.begin() + static_cast<std::ptrdiff_t>(piece.end));
  };
  return thinned(shown(curve, part(curve.x_measured), part(y)), kCorners);
}

std::string titled(const std::string& name, const std::string& unit) {
  return unit.empty() || unit == "1" ? name : fmt::format("{} [{}]", name, typeset_unit(unit));
}

/// Returns the names of the levels of the curve's pieces, in order; pieces of the same level have
/// the same color.
std::vector<std::string> levels_of(const MeasuredCurve& curve) {
  std::vector<std::string> levels;
  for (const MeasuredCurve::Piece& piece : curve.pieces)
    if (std::find(levels.begin(), levels.end(), piece.level) == levels.end())
      levels.push_back(piece.level);
  return levels;
}

std::string color_of(const std::vector<std::string>& levels, const std::string& level) {
  return category(
      static_cast<int>(std::find(levels.begin(), levels.end(), level) - levels.begin()));
}

/// Returns the channels in which pieces of one level differ, "gamma, p"; empty if every level has
/// one piece. The names of pieces are conditions, "Fz 1050 N, gamma 2 deg", the first of which is
/// the level.
std::string differing_within_levels(const MeasuredCurve& curve) {
  std::vector<std::string> channels;
  for (const MeasuredCurve::Piece& piece : curve.pieces) {
    if (piece.name.size() <= piece.level.size() + 2) continue;
    std::istringstream rest(piece.name.substr(piece.level.size() + 2));
    for (std::string condition; std::getline(rest >> std::ws, condition, ',');)
      if (const std::string channel = condition.substr(0, condition.find(' '));
          std::find(channels.begin(), channels.end(), channel) == channels.end())
        channels.push_back(channel);
  }
  return fmt::format("{}", fmt::join(channels, ", "));
}

/// Draws the legend: the line styles, then one entry for each level of pieces. Returns the height,
/// px, of its rows beyond the first.
double draw_key(Svg& svg, const MeasuredCurve& curve) {
  const std::string simulated(drawn_as(curve.fitted, curve.of_design));
  const std::vector<std::string> levels = levels_of(curve);
  if (levels.empty()) {
    double at = draw_legend(svg, {72, 18}, "measured", true, "measured");
    at = draw_legend(svg, {at, 18}, "found", false, simulated);
    if (!curve.y_initial.empty()) draw_legend(svg, {at, 18}, "initial", false, "initial values");
    return 0.0;
  }
  const std::string within = differing_within_levels(curve);
  svg.text({72, 18},
           "circles: measured, lines: " + simulated +
               (curve.y_initial.empty() ? "" : ", gray: initial values") +
               (within.empty() ? "" : "; lines of a color differ in " + within));
  Point at(72, 18 + kKeyRow);
  for (const std::string& level : levels) {
    const double width = 42 + 6.4 * static_cast<double>(level.size());
    if (at.x() > 72 && at.x() + width > 510) at = {72, at.y() + kKeyRow};
    const std::string color = color_of(levels, level);
    svg.line({at.x(), at.y() - 4},
             {at.x() + 18, at.y() - 4},
             fmt::format("stroke=\"{}\" stroke-width=\"2\"", color));
    svg.circle(
        {at.x() + 9, at.y() - 4}, 2.6, fmt::format("class=\"of-level\" stroke=\"{}\"", color));
    svg.text({at.x() + 24, at.y()}, level);
    at.x() += width;
  }
  return at.y() - 18;
}

/// Draws the measured samples of a curve or of one piece as circles, whose tooltips show the
/// values.
void draw_dots(Svg& svg,
               const Axis& x,
               const Axis& y,
               const Samples& dots,
               const MeasuredCurve& curve,
               const std::string& style,
               const std::string& name = "") {
  for (std::size_t k = 0; k < dots.x.size(); ++k) {
    svg.circle({x.at(dots.x[k]), y.at(dots.y[k])},
               name.empty() ? 3 : 2.2,
               style,
               fmt::format("{}{}{}: measured {}{}",
                           name.empty() ? "" : name + ", ",
                           significant(dots.x[k], 4),
                           unit_suffix(curve.x_unit),
                           significant(dots.y[k], 5),
                           unit_suffix(curve.y_unit)));
  }
}

void draw_pieces(Svg& svg, const Axis& x, const Axis& y, const MeasuredCurve& curve) {
  const std::vector<std::string> levels = levels_of(curve);
  const std::size_t most = std::max<std::size_t>(12, 3 * kDots / curve.pieces.size());
  const auto draw = [&](const Samples& samples, const std::string& style) {
    if (!samples.y.empty()) svg.polyline(points_of(x, y, samples.x, samples.y), style);
  };
  for (const MeasuredCurve::Piece& piece : curve.pieces) {
    const std::string color = color_of(levels, piece.level);
    draw(piece_of(curve, piece, curve.y_initial), "class=\"initial\"");
    draw(piece_of(curve, piece, curve.y_simulated),
         fmt::format("fill=\"none\" stroke=\"{}\" stroke-width=\"1.4\"", color));
    draw_dots(svg,
              x,
              y,
              thinned(piece_of(curve, piece, curve.y_measured), most),
              curve,
              fmt::format("class=\"of-level\" stroke=\"{}\"", color),
              piece.name);
  }
}

/// Plots the errors below the curve, moved downward by `down`, px.
void draw_errors(
    Svg& svg, const Axis& x, const Samples& errors, const std::string& x_title, double down) {
  const Axis y = Axis::around(errors.y, 372 + down, 302 + down, /*zero=*/true);
  draw_frame(svg, x, y, x_title, "Error [%]", {.y_spacing = 22.0});
  svg.line({x.first_pixel(), y.at(0)}, {x.last_pixel(), y.at(0)}, "class=\"axis\"");
  for (std::size_t k = 0; k < errors.x.size(); ++k) {
    if (!std::isfinite(errors.y[k])) continue;
    const Point top(x.at(errors.x[k]), y.at(errors.y[k]));
    svg.line({top.x(), y.at(0)}, top, "class=\"found\"");
    svg.circle(top, 2.4, "class=\"found-dot\"", signed_percent(errors.y[k] / 100.0));
  }
}

}  // namespace

std::string curve_plot(const MeasuredCurve& curve) {
  const Samples measured = shown(curve, curve.x_measured, curve.y_measured);
  const Axis x = Axis::around(measured.x, 72, 500);
  const Samples simulated =
      thinned(shown(curve, curve.x_simulated, curve.y_simulated, &x), kCorners);
  const Samples initial = thinned(shown(curve, curve.x_initial, curve.y_initial, &x), kCorners);
  std::vector<double> all = measured.y;
  all.insert(all.end(), simulated.y.begin(), simulated.y.end());
  all.insert(all.end(), initial.y.begin(), initial.y.end());
  const Samples lower = thinned(shown(curve, curve.x_band, curve.band.lower), kCorners),
                upper = thinned(shown(curve, curve.x_band, curve.band.upper), kCorners);
  Svg key(0, 0, "");
  const double down = draw_key(key, curve);
  const Axis y = Axis::around(with_band(all, lower.y, upper.y), 270 + down, 34 + down);

  Svg svg(520, 416 + down, "Measured and simulated curve, " + curve.experiment);
  draw_key(svg, curve);
  draw_frame(svg, x, y, "", titled(curve.y_name, curve.y_unit), {.label_x = false});
  draw_band(svg, x, y, lower.x, lower.y, upper.y);
  const auto draw = [&](const Samples& samples, const char* style) {
    if (!samples.y.empty()) svg.polyline(points_of(x, y, samples.x, samples.y), style);
  };
  if (curve.pieces.empty()) {
    draw(initial, "class=\"initial\"");
    draw(simulated, "class=\"found\"");
    draw_dots(svg, x, y, thinned(measured, kDots), curve, "class=\"measured\"");
  } else {
    draw_pieces(svg, x, y, curve);
  }
  Samples errors{measured.x, curve.errors};
  for (double& error : errors.y) error *= 100.0;
  const std::string x_title = curve.x_name.empty() ? "Sample" : titled(curve.x_name, curve.x_unit);
  draw_errors(svg, x, thinned(errors, kDots), x_title, down);
  return svg.str();
}

}  // namespace latsch::report
