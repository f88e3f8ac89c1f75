// SPDX-License-Identifier: Apache-2.0
#include "experiment/tests/pictures/rolling_footprint_pictures.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <string>

#include "experiment/tests/pictures/footprint_pictures.h"

namespace latsch::experiment {
namespace {

/// A quantity of a point that has a picture of its own.
struct DrawnQuantity {
  const char *title, *unit;
  double factor;
  int digits;
  double (*of)(const RollingPoint&);
};

constexpr DrawnQuantity kDrawn[] = {
    {"Pressure", "bar", 1e5, 2, [](const RollingPoint& at) { return at.pressure; }},
    {"Shear",
     "bar",
     1e5,
     2,
     [](const RollingPoint& at) { return std::hypot(at.shear_x, at.shear_y); }},
    {"Grip |t|/(mu p)", "1", 1.0, 2, [](const RollingPoint& at) { return at.grip; }},
    {"Sliding speed", "m/s", 1.0, 3, [](const RollingPoint& at) {
       return std::hypot(at.slide_x, at.slide_y);
     }}};

std::string in_words(const RolledState& rolled, const RollingFootprint& print) {
  const fe_tire::RollingCase& of = rolled.state.of;
  constexpr double kDegree = M_PI / 180.0;
  return fmt::format(
      "{:.0f} N, {:.1f} km/h, slip angle {:.3g} deg, slip {:.3g}, camber {:.3g} deg; {:.1f} mm "
      "long, {:.1f} mm wide, grip level {:.2f}. From above, forward to the right.",
      print.footprint.load,
      3.6 * of.speed,
      of.slip_angle / kDegree,
      rolled.kappa,
      of.camber / kDegree,
      1e3 * print.footprint.length,
      1e3 * print.footprint.width,
      print.footprint.grip_level());
}

Channels point_channels(const std::vector<RollingFootprint>& prints) {
  Channels channels;
  const auto add = [&](const char* name, const char* unit, const auto& value) {
    std::vector<double> values;
    for (std::size_t i = 0; i < prints.size(); ++i)
      for (const RollingPoint& at : prints[i].points) values.push_back(value(at, i));
    channels.add({name, unit, std::move(values)});
  };
  using Point = const RollingPoint&;
  add("state", "1", [](Point, std::size_t i) { return static_cast<double>(i + 1); });
  add("line", "1", [](Point at, std::size_t) { return static_cast<double>(at.line); });
  add("x", "m", [](Point at, std::size_t) { return at.x; });
  add("y", "m", [](Point at, std::size_t) { return at.y; });
  add("pressure", "Pa", [](Point at, std::size_t) { return at.pressure; });
  add("shear_x", "Pa", [](Point at, std::size_t) { return at.shear_x; });
  add("shear_y", "Pa", [](Point at, std::size_t) { return at.shear_y; });
  add("slide_x", "m/s", [](Point at, std::size_t) { return at.slide_x; });
  add("slide_y", "m/s", [](Point at, std::size_t) { return at.slide_y; });
  add("grip", "1", [](Point at, std::size_t) { return at.grip; });
  add("power", "W/m^2", [](Point at, std::size_t) { return at.power; });
  return channels;
}

}  // namespace

Test::Details rolling_footprint_details(const std::vector<RolledState>& states) {
  std::vector<RollingFootprint> prints;
  for (const RolledState& rolled : states) prints.push_back(footprint_of(rolled.state));
  Test::Details details;
  double most[std::size(kDrawn)];
  for (std::size_t q = 0; q < std::size(kDrawn); ++q) {
    most[q] = 1e-9;
    for (const RollingFootprint& print : prints)
      for (const RollingPoint& at : print.points) most[q] = std::max(most[q], kDrawn[q].of(at));
  }
  for (std::size_t i = 0; i < states.size(); ++i) {
    for (std::size_t q = 0; q < std::size(kDrawn); ++q) {
      const DrawnQuantity& drawn = kDrawn[q];
      std::vector<double> values;
      for (const RollingPoint& at : prints[i].points) values.push_back(drawn.of(at));
      const std::string title = fmt::format("State {}: {}", i + 1, drawn.title);
      const FootprintMap map{title, drawn.unit, drawn.factor, drawn.digits, most[q]};
      details.pictures.push_back(
          {title, footprint_map(prints[i].footprint, values, map), in_words(states[i], prints[i])});
    }
  }
  details.numbers = point_channels(prints);
  return details;
}

}  // namespace latsch::experiment
