// SPDX-License-Identifier: Apache-2.0
#include "models/tire/footprint.h"

#include <algorithm>
#include <cmath>

namespace latsch {
namespace {

/// Returns the length, m, over which a sensor covers a tread element, along one axis. The element
/// has this center and length. Near its ends its share of the pressure fades over the distance b,
/// and the covered length is weighted accordingly.
double on_sensor(double at, double side, double center, double length, double b) {
  const double z = at - center;
  if (std::abs(z) >= 0.5 * (side + length + b)) return 0.0;
  if (!(b > 0.0))
    return std::min(z + 0.5 * side, 0.5 * length) - std::max(z - 0.5 * side, -0.5 * length);
  const auto square = [](double s) { return s > 0.0 ? 0.5 * s * s : 0.0; };
  const auto up_to = [&](double s) {
    const double outer = 0.5 * (length + b), inner = 0.5 * (length - b);
    return (square(s + outer) - square(s + inner) - square(s - inner) + square(s - outer)) / b;
  };
  return up_to(z + 0.5 * side) - up_to(z - 0.5 * side);
}

}  // namespace

double Footprint::pressure_at(double x, double y, double side) const {
  double force = 0.0;
  for (const FootprintElement& at : elements) {
    const double along = on_sensor(x, side, at.x, at.length, at.blur * at.length);
    if (along > 0.0)
      force += at.pressure * along * on_sensor(y, side, at.y, at.width, at.blur * at.width);
  }
  return force / (side * side);
}

double Footprint::peak_pressure(double side) const {
  if (elements.empty()) return 0.0;
  // Number of steps per side of the sensor in the first search, and the step, relative to the side,
  // at which the search ends.
  constexpr double kSteps = 6.0, kLast = 1e-3;
  const auto by_x = [](const auto& a, const auto& b) { return a.x < b.x; };
  const auto by_y = [](const auto& a, const auto& b) { return a.y < b.y; };
  const auto [back, front] = std::ranges::minmax_element(elements, by_x);
  const auto [right, left] = std::ranges::minmax_element(elements, by_y);
  double step = side / kSteps, peak = 0.0, peak_x = 0.0, peak_y = 0.0;
  const auto look_at = [&](double x, double y) {
    const double pressure = pressure_at(x, y, side);
    if (pressure <= peak) return;
    peak = pressure;
    peak_x = x;
    peak_y = y;
  };
  for (double x = back->x - 0.5 * side; x <= front->x + 0.5 * side; x += step) {
    for (double y = right->y - 0.5 * side; y <= left->y + 0.5 * side; y += step) look_at(x, y);
  }
  for (step *= 0.5; step > kLast * side; step *= 0.5) {
    const double x = peak_x, y = peak_y;
    for (const double along : {-step, 0.0, step})
      for (const double across : {-step, 0.0, step}) look_at(x + along, y + across);
  }
  return peak;
}

double Footprint::grip_level() const {
  double used = 0.0, all = 0.0;
  for (const FootprintElement& at : elements) {
    const double limit = at.friction * at.pressure;
    used += std::min(limit, std::hypot(at.shear_x, at.shear_y)) * at.area();
    all += limit * at.area();
  }
  return all > 0.0 ? used / all : 0.0;
}

}  // namespace latsch
