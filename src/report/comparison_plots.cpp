// SPDX-License-Identifier: Apache-2.0
#include "report/comparison_plots.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <limits>

#include "report/html_text.h"
#include "report/svg_plot.h"

namespace latsch::report {
namespace {

constexpr double kMillimeter = 1e-3;
constexpr double kKilonewton = 1e3;
constexpr double kNaN = std::numeric_limits<double>::quiet_NaN();

std::vector<double> scaled(const std::vector<double>& values, double unit) {
  std::vector<double> result(values);
  for (double& v : result) v /= unit;
  return result;
}

void draw_errors(Svg& svg,
                 const Axis& x,
                 const ComparedForces& curve,
                 const std::vector<double>& abscissa,
                 std::string_view x_title) {
  std::vector<double> errors;
  for (size_t k = 0; k < abscissa.size(); ++k) {
    errors.push_back(100.0 * (curve.measured[k] - curve.simulated[k]) / curve.measured[k]);  // (2)
  }
  const Axis y = Axis::around(errors, 372, 302, /*zero=*/true);
  draw_frame(svg, x, y, x_title, "ΔF [%]", {.y_spacing = 22.0});
  svg.line({x.first_pixel(), y.at(0)}, {x.last_pixel(), y.at(0)}, "class=\"axis\"");
  for (size_t k = 0; k < abscissa.size(); ++k) {
    if (!std::isfinite(errors[k])) continue;
    const Point top(x.at(abscissa[k]), y.at(errors[k]));
    svg.line({top.x(), y.at(0)}, top, "class=\"found\"");
    svg.circle(
        top,
        3.2,
        "class=\"found-dot\"",
        fmt::format("{} mm: {}", significant(abscissa[k], 4), signed_percent(errors[k] / 100.0)));
  }
}

}  // namespace

std::string force_plot(const ComparedForces& curve) {
  std::vector<double> abscissa = scaled(curve.abscissa, kMillimeter);
  abscissa.resize(std::min({abscissa.size(), curve.measured.size(), curve.simulated.size()}));
  const auto measured = scaled(curve.measured, kKilonewton),
             simulated = scaled(curve.simulated, kKilonewton),
             initial = scaled(curve.initial, kKilonewton);
  std::vector<double> forces = measured;
  forces.insert(forces.end(), simulated.begin(), simulated.end());
  forces.insert(forces.end(), initial.begin(), initial.end());
  const Axis x = Axis::around(abscissa, 62, 500, !curve.over_loaded_radius);
  const auto lower = scaled(curve.band.lower, kKilonewton),
             upper = scaled(curve.band.upper, kKilonewton);
  const Axis y = Axis::around(with_band(forces, lower, upper), 270, 34, /*zero=*/true);

  Svg svg(520, 416, "Measured and simulated force, " + curve.experiment);
  double at = draw_legend(svg, {62, 18}, "measured", true, "measured");
  at = draw_legend(svg, {at, 18}, "found", false, drawn_as(curve.fitted, curve.of_design));
  if (!initial.empty()) draw_legend(svg, {at, 18}, "initial", false, "initial values");
  draw_frame(svg, x, y, "", "Force [kN]", {.label_x = false});
  draw_band(svg, x, y, abscissa, lower, upper);
  if (!initial.empty()) svg.polyline(points_of(x, y, abscissa, initial), "class=\"initial\"");
  svg.polyline(points_of(x, y, abscissa, simulated), "class=\"found\"");
  for (size_t k = 0; k < abscissa.size(); ++k) {
    svg.circle({x.at(abscissa[k]), y.at(measured[k])},
               4,
               "class=\"measured\"",
               fmt::format("{} mm: measured {} N, simulated {} N",
                           significant(abscissa[k], 4),
                           significant(curve.measured[k], 5),
                           significant(curve.simulated[k], 5)));
  }
  draw_errors(
      svg, x, curve, abscissa, curve.over_loaded_radius ? "Loaded radius [mm]" : "Deflection [mm]");
  return svg.str();
}

std::string frequency_plot(const ModalComparison& comparison) {
  constexpr double kRow = 23.0, kTop = 30.0, kLeft = 178.0, kRight = 560.0;
  const auto rows = static_cast<double>(comparison.pairs.size());
  std::vector<double> errors, lower, upper;
  for (const ComparedModes& pair : comparison.pairs) {
    const auto error = [&](double f) {
      return 100.0 * (pair.measured - f) / pair.measured;
    };  // (1)
    errors.push_back(error(pair.simulated));
    if (pair.initial) errors.push_back(error(*pair.initial));
    const std::size_t k = lower.size();
    lower.push_back(k < comparison.band.upper.size() ? error(comparison.band.upper[k]) : kNaN);
    upper.push_back(k < comparison.band.lower.size() ? error(comparison.band.lower[k]) : kNaN);
  }
  const Axis x = Axis::around(with_band(errors, lower, upper), kLeft, kRight, /*zero=*/true);
  const double bottom = kTop + kRow * rows;
  Svg svg(780, bottom + 46, "Relative difference of the frequencies, " + comparison.experiment);
  for (const auto& tick : x.ticks()) {
    svg.line({x.at(tick.value), kTop}, {x.at(tick.value), bottom}, "class=\"grid\"");
    svg.text({x.at(tick.value), bottom + 16}, tick.label, TextAnchor::middle);
  }
  svg.text({0.5 * (kLeft + kRight), bottom + 36},
           "Δf = (measured − simulated) / measured [%]",
           TextAnchor::middle,
           "title");
  svg.text({640, kTop - 10}, "measured", TextAnchor::end, "title");
  svg.text({710, kTop - 10}, "simulated", TextAnchor::end, "title");
  svg.text({774, kTop - 10}, "Δf", TextAnchor::end, "title");
  size_t next = 0;
  for (size_t k = 0; k < comparison.pairs.size(); ++k) {
    const ComparedModes& pair = comparison.pairs[k];
    const double y = kTop + kRow * static_cast<double>(k), middle = y + 0.5 * kRow + 4;
    const double error = errors[next++];
    svg.text({kLeft - 12, middle}, pair.label, TextAnchor::end, "label");
    std::string tip = fmt::format("{}: {}", pair.label, signed_percent(error / 100.0));
    if (pair.likeness) tip += fmt::format(", MAC {}", fixed(*pair.likeness, 3));
    if (pair.initial) {
      const double before = errors[next++];
      svg.rectangle(
          {std::min(x.at(0.0), x.at(before)), y + 3},
          std::abs(x.at(before) - x.at(0.0)),
          kRow - 6,
          "class=\"initial-bar\"",
          fmt::format("{}, initial values: {}", pair.label, signed_percent(before / 100.0)));
    }
    svg.rectangle({std::min(x.at(0.0), x.at(error)), y + 6},
                  std::max(1.0, std::abs(x.at(error) - x.at(0.0))),
                  kRow - 12,
                  "class=\"found-bar\"",
                  tip);
    if (std::isfinite(lower[k]) && std::isfinite(upper[k])) {
      const auto end = [&](double value) {
        return Point(x.at(std::clamp(value, x.lower(), x.upper())), y + 0.5 * kRow);
      };
      svg.line(end(lower[k]), end(upper[k]), "class=\"ink\"");
    }
    svg.text({640, middle}, fixed(pair.measured, 1), TextAnchor::end, "number");
    svg.text({710, middle}, fixed(pair.simulated, 1), TextAnchor::end, "number");
    svg.text({774, middle}, signed_percent(error / 100.0, 1), TextAnchor::end, "number");
  }
  svg.line({x.at(0), kTop}, {x.at(0), bottom}, "class=\"axis\"");
  return svg.str();
}

std::string convergence_plot(const Convergence& convergence) {
  std::vector<double> percents;
  for (double t : convergence.target) percents.push_back(100.0 * t);
  const Axis y = Axis::logarithmic_around(percents, 290, 26);
  const Axis x(0.0, std::max(1.0, static_cast<double>(percents.size())), 72, 680);
  constexpr double kRoomForBest = 140.0;  // px, width reserved for the label of the best target
  Svg svg(x.last_pixel() + kRoomForBest, 336, "Target over trials");
  draw_frame(svg, x, y, "Trial", "Target [%]");
  double best = std::numeric_limits<double>::infinity();
  std::vector<Point> staircase;
  for (size_t k = 0; k < percents.size(); ++k) {
    const double px = x.at(static_cast<double>(k) + 1.0);
    if (!std::isfinite(percents[k])) {
      svg.path(fmt::format("M{0:.1f} 282l6 6m0 -6l-6 6", px - 3), "class=\"failed\"");
    } else {
      const double value = std::max(percents[k], y.lower());
      svg.circle({px, y.at(value)},
                 2.2,
                 "class=\"trial\"",
                 fmt::format("trial {}: {} %", k + 1, significant(percents[k], 4)));
      if (percents[k] < best) {
        if (!staircase.empty()) staircase.push_back({px, y.at(std::max(best, y.lower()))});
        best = percents[k];
        staircase.push_back({px, y.at(value)});
      }
    }
    if (k + 1 == percents.size() && !staircase.empty())
      staircase.push_back({px, y.at(std::max(best, y.lower()))});
  }
  svg.polyline(staircase, "class=\"found\"");
  if (std::isfinite(best)) {
    svg.text({x.last_pixel() + 8, y.at(std::max(best, y.lower())) + 4},
             "best " + significant(best, 3) + " %",
             TextAnchor::start,
             "strong");
  }
  return svg.str();
}

}  // namespace latsch::report
