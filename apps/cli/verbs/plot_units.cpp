// SPDX-License-Identifier: Apache-2.0
#include "cli/verbs/plot_units.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>

namespace latsch::cli {
namespace {

constexpr double kDeg = 180.0 / std::numbers::pi;

struct Reading {
  const char *si, *unit;
  double factor;
  // Range of the largest magnitude, in SI, for which the unit is suitable.
  double from = 0.0, below = 1e300;
};
constexpr std::array<Reading, 9> kReadings = {{{"m", "mm", 1e3, 0.0, 1.0},
                                               {"rad", "deg", kDeg},
                                               {"N", "kN", 1e-3, 1e3},
                                               {"m/N", "mm/kN", 1e6},
                                               {"rad/N", "deg/kN", 1e3 * kDeg},
                                               {"rad/(N m)", "deg/(kN m)", 1e3 * kDeg},
                                               {"rad/m", "deg/m", kDeg},
                                               {"N/m", "N/mm", 1e-3, 1e3},
                                               {"m^2", "cm^2", 1e4, 0.0, 1.0}}};

}  // namespace

PlotUnit plot_unit(const std::string& si, const std::vector<double>& values) {
  double largest = 0.0;
  for (const double value : values)
    if (std::isfinite(value)) largest = std::max(largest, std::abs(value));
  for (const Reading& one : kReadings)
    if (si == one.si && largest >= one.from && largest < one.below) return {one.unit, one.factor};
  return {si, 1.0};
}

std::vector<double> in_plot_unit(std::vector<double> values, const PlotUnit& unit) {
  for (double& value : values) value *= unit.factor;
  return values;
}

}  // namespace latsch::cli
