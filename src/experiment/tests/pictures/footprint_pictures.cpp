// SPDX-License-Identifier: Apache-2.0
#include "experiment/tests/pictures/footprint_pictures.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "report/color_map.h"
#include "report/svg_plot.h"

namespace latsch::experiment {
namespace {

using report::Axis;

/// Returns all elements, each with the number of its state.
Channels element_channels(const std::vector<StandingFootprint>& states) {
  Channel state{"state", "1", {}}, x{"x", "m", {}}, y{"y", "m", {}}, pressure{"pressure", "Pa", {}};
  Channel shear_x{"shear_x", "Pa", {}}, shear_y{"shear_y", "Pa", {}};
  for (std::size_t i = 0; i < states.size(); ++i)
    for (const FootprintElement& at : states[i].footprint.elements) {
      state.values.push_back(static_cast<double>(i + 1));
      x.values.push_back(at.x);
      y.values.push_back(at.y);
      pressure.values.push_back(at.pressure);
      shear_x.values.push_back(at.shear_x);
      shear_y.values.push_back(at.shear_y);
    }
  Channels channels;
  for (Channel* channel : {&state, &x, &y, &pressure, &shear_x, &shear_y})
    channels.add(std::move(*channel));
  return channels;
}

}  // namespace

std::string footprint_map(const Footprint& print,
                          const std::vector<double>& values,
                          const FootprintMap& map) {
  constexpr double kLeft = 64.0, kTop = 28.0, kScale = 2.2;  // pixels, pixels a millimeter
  double x = 10.0, y = 10.0;
  for (const FootprintElement& at : print.elements) {
    x = std::max(x, 1e3 * (std::abs(at.x) + 0.5 * at.length) + 5.0);
    y = std::max(y, 1e3 * (std::abs(at.y) + 0.5 * at.width) + 5.0);
  }
  const double right = kLeft + 2.0 * kScale * x, bottom = kTop + 2.0 * kScale * y;
  report::Svg svg(right + 110.0, bottom + 48.0, map.title);
  const Axis along(-x, x, kLeft, right), across(-y, y, bottom, kTop);
  draw_frame(svg, along, across, "x [mm]", "y [mm]");
  for (std::size_t k = 0; k < values.size(); ++k) {
    const FootprintElement& at = print.elements[k];
    const report::Point corner(along.at(1e3 * (at.x - 0.5 * at.length)),
                               across.at(1e3 * (at.y + 0.5 * at.width)));
    svg.rectangle(corner,
                  kScale * 1e3 * at.length,
                  kScale * 1e3 * at.width,
                  fmt::format("fill=\"{}\"", report::viridis(values[k] / map.most)),
                  fmt::format("x {:.1f} mm, y {:.1f} mm: {:.{}f} {}",
                              1e3 * at.x,
                              1e3 * at.y,
                              values[k] / map.factor,
                              map.digits,
                              map.unit));
  }
  draw_color_bar(svg,
                 {right + 24.0, kTop},
                 bottom - kTop,
                 Axis(0.0, map.most / map.factor, bottom, kTop),
                 map.unit);
  return svg.str();
}

Test::Details footprint_details(const std::vector<StandingFootprint>& states) {
  double most = 1e-9;
  for (const StandingFootprint& state : states)
    for (const FootprintElement& at : state.footprint.elements) most = std::max(most, at.pressure);
  Test::Details details;
  for (const StandingFootprint& state : states) {
    const Footprint& print = state.footprint;
    std::vector<double> pressures;
    for (const FootprintElement& at : print.elements) pressures.push_back(at.pressure);
    details.pictures.push_back(
        {fmt::format("{:.0f} N", print.load),
         footprint_map(print, pressures, {"Pressure in the footprint", "bar", 1e5, 2, most}),
         fmt::format("Deflection {:.2f} mm; {:.1f} mm long, {:.1f} mm wide, {:.1f} cm², mean "
                     "pressure {:.2f} bar. From above, forward to the right; pressure over the "
                     "tread with its grooves.",
                     1e3 * state.deflection,
                     1e3 * print.length,
                     1e3 * print.width,
                     1e4 * print.area,
                     print.mean_pressure() / 1e5)});
  }
  details.numbers = element_channels(states);
  return details;
}

}  // namespace latsch::experiment
