// SPDX-License-Identifier: Apache-2.0
#include "report/identifiability_plots.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "report/html_text.h"
#include "report/svg_plot.h"

namespace latsch::report {
namespace {

// share of the range; smaller standard deviations are drawn at this value
constexpr double kLeastDeviation = 1e-6;
// highest rise shown, in thresholds; beyond it the curve leaves the frame
constexpr double kHighestRise = 8.0;

constexpr double kLetter = 6.5;    // px, approximate width of a letter
constexpr double kColumn = 520.0;  // px, width of a picture that stands beside another one

/// Returns the width, px, at the left of a picture for the longest of the words, at least `least`.
double room_for(const std::vector<std::string>& words, double least) {
  double widest = least;
  for (const std::string& word : words)
    widest = std::max(widest, 16.0 + kLetter * static_cast<double>(word.size()));
  return widest;
}

/// Returns the style of a cell: white at correlation 0, a warm color toward +1, a cold one toward
/// -1.
std::string cell_style(double correlation) {
  return fmt::format("class=\"{}\" fill-opacity=\"{:.3f}\"",
                     correlation >= 0.0 ? "warm" : "cold",
                     std::min(1.0, std::abs(correlation)));
}

}  // namespace

std::string spectrum_plot(const IdentifiabilityPage& what) {
  constexpr double kRow = 28.0, kTop = 14.0, kBars = 290.0;
  const double kLeft = room_for(what.directions, 210.0), kRight = kLeft + kBars;
  const auto rows = static_cast<double>(what.deviations.size());
  std::vector<double> percents{100.0};
  for (double d : what.deviations) percents.push_back(100.0 * std::clamp(d, kLeastDeviation, 1.0));
  const Axis x(
      0.5 * *std::min_element(percents.begin(), percents.end()), 200.0, kLeft, kRight, true);
  const double bottom = kTop + kRow * rows;
  Svg svg(std::max(kColumn, kRight + 20.0),
          bottom + 50,
          "Standard deviation along the directions of the variables");
  for (const auto& tick : x.ticks()) {
    svg.line({x.at(tick.value), kTop}, {x.at(tick.value), bottom}, "class=\"grid\"");
    svg.text({x.at(tick.value), bottom + 16}, tick.label, TextAnchor::middle);
  }
  svg.text({0.5 * (kLeft + kRight), bottom + 38},
           "Standard deviation [% of the range]",
           TextAnchor::middle,
           "title");
  for (size_t k = 0; k < what.deviations.size(); ++k) {
    const double y = kTop + kRow * static_cast<double>(k);
    const bool flat = what.deviations[k] >= 1.0;
    svg.text({kLeft - 10, y + 0.5 * kRow + 4}, what.directions[k], TextAnchor::end, "label");
    svg.rectangle({kLeft, y + 6},
                  std::max(1.5, x.at(percents[k + 1]) - kLeft),
                  kRow - 12,
                  flat ? "class=\"warm\"" : "class=\"found-bar\"",
                  flat ? "flat: more than the whole range"
                       : fmt::format("{} % of the range", significant(percents[k + 1], 3)));
  }
  svg.line({x.at(100.0), kTop}, {x.at(100.0), bottom}, "class=\"axis\"");
  return svg.str();
}

std::string correlation_plot(const IdentifiabilityPage& what) {
  constexpr double kTop = 34.0;
  std::vector<std::string> rows;
  for (const std::string& variable : what.variables) rows.push_back(variable + " (22)");
  const double kLeft = room_for(rows, 130.0);
  const auto n = static_cast<Eigen::Index>(what.variables.size());
  const double cell = std::clamp(300.0 / static_cast<double>(n), 26.0, 64.0);
  // The variables' names stand above the columns if all of them fit; otherwise the numbers of the
  // rows do.
  const bool are_short =
      std::all_of(what.variables.begin(), what.variables.end(), [&](const std::string& variable) {
        return kLetter * static_cast<double>(variable.size()) <= cell;
      });
  const auto column_number = [](Eigen::Index i) { return fmt::format("({})", i + 1); };
  const double width = cell * static_cast<double>(n);
  Svg svg(
      std::max(kColumn, kLeft + width + 8.0), kTop + width + 12, "Correlations of the variables");
  for (Eigen::Index i = 0; i < n; ++i) {
    const double y = kTop + cell * static_cast<double>(i);
    const std::string row =
        are_short ? what.variables[i] : what.variables[i] + " " + column_number(i);
    svg.text({kLeft - 10, y + 0.5 * cell + 4}, row, TextAnchor::end, "label");
    for (Eigen::Index j = 0; j < n; ++j) {
      const double x = kLeft + cell * static_cast<double>(j), r = what.correlation(i, j);
      // A variable at its bound does not vary, so it has no correlation, not even with itself.
      const bool is_held = what.correlation(i, i) == 0.0 || what.correlation(j, j) == 0.0;
      const std::string shown = is_held ? "–" : fixed(r, 2);
      svg.rectangle({x + 1, y + 1},
                    cell - 2,
                    cell - 2,
                    cell_style(r),
                    fmt::format("{} and {}: {}",
                                what.variables[i],
                                what.variables[j],
                                is_held ? "one is held at its bound" : fixed(r, 3)));
      if (cell >= 40.0)
        svg.text({x + 0.5 * cell, y + 0.5 * cell + 4},
                 shown,
                 TextAnchor::middle,
                 std::abs(r) > 0.5 ? "on-field" : "number");
    }
    svg.text({kLeft + cell * (static_cast<double>(i) + 0.5), kTop - 10},
             are_short ? what.variables[i] : column_number(i),
             TextAnchor::middle);
  }
  return svg.str();
}

std::string profile_plot(const ProfileCurve& curve) {
  std::vector<double> x;
  for (double v : curve.x) x.push_back(in_unit(v, curve.unit));
  const Axis across(x.front(), x.back(), 62, 500, curve.logarithmic && x.front() > 0.0);
  const Axis up(0.0, kHighestRise, 250, 20);
  Svg svg(520, 300, "Profile of " + curve.variable);
  draw_frame(svg,
             across,
             up,
             curve.variable + (curve.unit == "1" ? "" : " [" + typeset_unit(curve.unit) + "]"),
             "Rise of the misfit [of the 95 % limit]");
  std::vector<Point> points;
  const auto place = [&](size_t k) { return Point(across.at(x[k]), up.at(curve.rise[k])); };
  for (size_t k = 0; k < x.size(); ++k) {
    if (k > 0 && (curve.rise[k] > kHighestRise) != (curve.rise[k - 1] > kHighestRise)) {
      const double share = (kHighestRise - curve.rise[k - 1]) / (curve.rise[k] - curve.rise[k - 1]);
      points.push_back(place(k - 1) + share * (place(k) - place(k - 1)));
    }
    if (curve.rise[k] <= kHighestRise) {
      points.push_back(place(k));
    } else if (!points.empty()) {
      svg.polyline(points, "class=\"found\"");
      points.clear();
    }
  }
  if (points.size() > 1) svg.polyline(points, "class=\"found\"");
  for (size_t k = 0; k < x.size(); ++k) {
    if (curve.rise[k] > kHighestRise) continue;
    svg.circle(place(k),
               2.6,
               "class=\"found-dot\"",
               fmt::format("{}: {} times the threshold",
                           true_minus(typeset_unit(curve.shown[k])),
                           significant(curve.rise[k], 3)));
  }
  svg.line(
      {across.first_pixel(), up.at(1.0)}, {across.last_pixel(), up.at(1.0)}, "class=\"limit\"");
  svg.text({across.last_pixel() - 4, up.at(1.0) - 6}, "95 %", TextAnchor::end);
  const double found = across.at(in_unit(curve.found, curve.unit));
  svg.line({found, up.first_pixel()}, {found, up.last_pixel()}, "class=\"initial\"");
  return svg.str();
}

}  // namespace latsch::report
