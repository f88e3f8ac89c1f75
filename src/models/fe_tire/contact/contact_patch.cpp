// SPDX-License-Identifier: Apache-2.0
#include "models/fe_tire/contact/contact_patch.h"

#include <algorithm>
#include <cmath>

namespace latsch::fe_tire {
namespace {

constexpr double kSteps = 6.0;  // of the search, in a sensor's side

/// m of a share of this length around `center` that a sensor around `at` has, by (P.1).
double on_sensor(double at, double side, double center, double length) {
  const double b = std::sqrt(0.5) * length;
  const auto square = [](double z) { return z > 0.0 ? 0.5 * z * z : 0.0; };
  const auto up_to = [&](double z) {
    const double outer = 0.5 * (length + b), inner = 0.5 * (length - b);
    return (square(z + outer) - square(z + inner) - square(z - inner) + square(z - outer)) / b;
  };
  const double z = at - center;
  if (std::abs(z) >= 0.5 * (side + length + b)) return 0.0;
  return up_to(z + 0.5 * side) - up_to(z - 0.5 * side);
}

}  // namespace

double ContactPatch::mean_pressure(double x, double y, double side) const {
  double force = 0.0;
  for (const Point& point : points) {
    const double along = on_sensor(x, side, point.x, point.length);
    if (along > 0.0)
      force += point.pressure * along * on_sensor(y, side, point.y, point.area / point.length);
  }
  return force / (side * side);
}

double ContactPatch::peak_pressure(double side) const {
  if (points.empty()) return 0.0;
  const auto by_x = [](const Point& a, const Point& b) { return a.x < b.x; };
  const auto by_y = [](const Point& a, const Point& b) { return a.y < b.y; };
  const auto [back, front] = std::ranges::minmax_element(points, by_x);
  const auto [right, left] = std::ranges::minmax_element(points, by_y);
  const double step = side / kSteps;
  double peak = 0.0;
  for (double x = back->x - 0.5 * side; x <= front->x + 0.5 * side; x += step) {
    for (double y = right->y - 0.5 * side; y <= left->y + 0.5 * side; y += step)
      peak = std::max(peak, mean_pressure(x, y, side));
  }
  return peak;
}

}  // namespace latsch::fe_tire
