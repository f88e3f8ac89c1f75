// SPDX-License-Identifier: Apache-2.0
// A measured curve of force over deflection, or over its rate: cubic between its points without
// overshoot, and straight beyond its ends. The slope at a point is the weighted harmonic mean of
// the slopes beside it if both have the same sign, else 0 [Fritsch, Butland 1984, SIAM J. Sci.
// Stat. Comput. 5(2), eqs. 5 - 7]. At the ends, and beyond them, it is that of the chord. So the
// curve is smooth, exact at its points, and monotonic wherever they are.
#pragma once

#include <string>
#include <utility>
#include <vector>

namespace latsch::multibody {

class ForceCharacteristic {
 public:
  using Point = std::pair<double, double>;  // deflection or its rate; force

  /// Returns an empty text if the points form a valid curve, otherwise a message: fewer than two
  /// points, numbers that are not finite, or x that does not increase.
  static std::string fault(const std::vector<Point>& points);
  /// Constructs the curve. The points must have no fault().
  explicit ForceCharacteristic(std::vector<Point> points);

  double at(double x) const;
  double slope(double x) const;
  /// Returns the integral of the force from 0 to x; in J if x is a deflection.
  double area(double x) const;
  const std::vector<Point>& points() const { return points_; }
  bool operator==(const ForceCharacteristic&) const = default;

 private:
  std::size_t interval(double x) const;
  double area_from_first(double x) const;

  std::vector<Point> points_;
  // Slopes at the points; integrals of the force from the first point to each point.
  std::vector<double> slopes_, areas_;
};

}  // namespace latsch::multibody
