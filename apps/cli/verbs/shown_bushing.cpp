// SPDX-License-Identifier: Apache-2.0
// Implements `latsch show` for a bushing property file: its stiffnesses and dampings, and its
// forces over the deflection.
#include <array>
#include <cmath>

#include "base/text.h"
#include "cli/verbs/shown_file.h"
#include "formats/car/bus_file.h"

namespace latsch::cli {
namespace {

using multibody::BushingParameters;

constexpr std::array<const char*, 6> kBushingAxes = {
    "x", "y", "z", "about x", "about y", "about z"};
constexpr int kBushingDigits = 6, kCurvePoints = 200;
// Range, m and rad, in which a linear curve is drawn.
constexpr double kBushingReach = 1e-3, kTurn = 0.1;

const multibody::ForceCharacteristic* curve_of(const BushingParameters& bushing, int axis) {
  for (const BushingParameters::Part& part : bushing.parts)
    if (part.axis == axis) return &std::get<multibody::ElasticCurve>(part.law).curve;
  return nullptr;
}

report::LinePlot plot_of_axis(int axis, double k, const multibody::ForceCharacteristic* curve) {
  const bool turns = axis >= 3;
  const double reach = turns ? kTurn : kBushingReach;
  const double from = curve ? curve->points().front().first : -reach,
               to = curve ? curve->points().back().first : reach;
  report::PlotLine line{"", {}, {}, 0, {}};
  for (int i = 0; i <= kCurvePoints; ++i) {
    const double x = from + (to - from) * i / kCurvePoints;
    line.x.push_back(x);
    line.y.push_back(curve ? curve->at(x) : k * x);
  }
  const std::string name = kBushingAxes[static_cast<std::size_t>(axis)];
  return {turns ? "Torque " + name : "Force along " + name,
          turns ? "angle [rad]" : name + " [m]",
          turns ? "torque [N m]" : "force [N]",
          {std::move(line)}};
}

}  // namespace

ShownFile shown_bushing(const std::filesystem::path& bus) {
  const formats::BusFile file = formats::read_bus_file(bus);
  const BushingParameters& bushing = file.bushing;
  ShownFile shown;
  shown.kind = "Bushing (.bus)";
  for (const formats::TeimOrbitPart& part : file.unused)
    shown.facts.push_back("not read: " + part.name);
  ShownTable table{"Axes, in SI", {"axis", "points", "stiffness at rest", "damping", "unit"}, {}};
  for (int axis = 0; axis < 6; ++axis) {
    const multibody::ForceCharacteristic* curve = curve_of(bushing, axis);
    const double k = (axis < 3 ? bushing.stiffness : bushing.rotational)[axis % 3];
    const double c = (axis < 3 ? bushing.damping : bushing.rotational_damping)[axis % 3];
    table.rows.push_back({kBushingAxes[static_cast<std::size_t>(axis)],
                          curve ? std::to_string(curve->points().size()) : "straight",
                          format_number(curve ? curve->slope(0.0) : k, kBushingDigits),
                          format_number(c, kBushingDigits),
                          axis < 3 ? "N/m, N s/m" : "N m/rad, N m s/rad"});
    shown.plots.push_back(plot_of_axis(axis, k, curve));
  }
  shown.tables.push_back(std::move(table));
  return shown;
}

}  // namespace latsch::cli
