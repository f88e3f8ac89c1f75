// SPDX-License-Identifier: Apache-2.0
#include "experiment/rigs/fe_rolling/free_radii.h"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <utility>

namespace latsch::experiment {
namespace {

/// A range up to which a polynomial has a number of points.
struct PointsOfRange {
  double most;
  int points;
};

/// Returns the Chebyshev points of a range, the middle alone if it is empty.
std::vector<double> chebyshev_points(std::pair<double, double> range, int count) {
  const auto [from, to] = range;
  if (count == 1) return {0.5 * (from + to)};
  std::vector<double> points;
  for (int k = 0; k < count; ++k)
    points.push_back(0.5 * (from + to) -
                     0.5 * (to - from) * std::cos(std::numbers::pi * k / (count - 1)));
  return points;
}

/// Returns the number of points that a range needs.
int points_for(double range, std::initializer_list<PointsOfRange> table, int most) {
  for (const PointsOfRange& one : table)
    if (range <= one.most) return one.points;
  return most;
}

/// Returns Lagrange's polynomials of these points at x.
std::vector<double> lagrange(const std::vector<double>& points, double x) {
  std::vector<double> values;
  for (const double own : points) {
    double value = 1.0;
    for (const double other : points)
      if (other != own) value *= (x - other) / (own - other);
    values.push_back(value);
  }
  return values;
}

template <class Of>
std::pair<double, double> range_of(const std::vector<RollingRow>& rows, const Of& of) {
  std::pair<double, double> range(of(rows.front()), of(rows.front()));
  for (const RollingRow& row : rows)
    range = {std::min(range.first, of(row)), std::max(range.second, of(row))};
  return range;
}

}  // namespace

FreeRadii::FreeRadii(const std::vector<RollingRow>& rows) {
  const auto loads = range_of(rows, [](const RollingRow& row) { return row.load; });
  const auto speeds = range_of(rows, [](const RollingRow& row) { return row.speed; });
  const auto cambers = range_of(rows, [](const RollingRow& row) { return row.camber; });
  // Ranges of loads and speeds are relative to the largest, those of camber in rad.
  loads_ = chebyshev_points(loads,
                            points_for(1.0 - loads.first / loads.second,
                                       {{1e-9, 1}, {0.01, 2}, {0.1, 3}, {0.4, 4}, {0.7, 5}},
                                       6));
  speeds_ = chebyshev_points(
      speeds, points_for(1.0 - speeds.first / speeds.second, {{1e-9, 1}, {0.02, 2}}, 3));
  cambers_ = chebyshev_points(
      cambers, points_for(cambers.second - cambers.first, {{1e-9, 1}, {0.002, 2}, {0.1, 3}}, 4));
  for (const double camber : cambers_)
    for (const double speed : speeds_)
      for (const double load : loads_) {
        RollingRow wheel{.load = load, .speed = speed};
        wheel.camber = camber;
        wheels_.push_back(wheel);
      }
}

double FreeRadii::at(double load, double speed, double camber) const {
  const auto by_load = lagrange(loads_, load), by_speed = lagrange(speeds_, speed),
             by_camber = lagrange(cambers_, camber);
  double radius = 0.0;
  std::size_t at = 0;
  for (const double c : by_camber)
    for (const double v : by_speed)
      for (const double f : by_load) radius += c * v * f * radii_[at++];
  return radius;
}

}  // namespace latsch::experiment
