// SPDX-License-Identifier: Apache-2.0
// A measured curve of force over deflection, or over its rate: cubic between its points, without
// overshoot, straight on beyond its ends.
//   slopes at the points: [Fritsch, Butland 1984, SIAM J. Sci. Stat. Comput. 5(2), eqs. 5 - 7], the
//   weighted harmonic mean of the slopes beside a point where both have one sign, else 0; at the
//   ends, and beyond them, that of the chord.
// So it is smooth, exact in its points, and rises wherever they do.
#pragma once

#include <string>
#include <utility>
#include <vector>

namespace latsch::multibody {

class ForceCurve {
 public:
  using Point = std::pair<double, double>;  // deflection or rate; force

  /// What is wrong, in words, or empty: fewer than two points, numbers that are none, x that does
  /// not rise.
  static std::string fault(const std::vector<Point>& points);
  /// Of points without fault.
  explicit ForceCurve(std::vector<Point> points);

  double at(double x) const;
  double slope(double x) const;
  /// Area below the curve from 0 to x, J where x is a deflection.
  double area(double x) const;
  const std::vector<Point>& points() const { return points_; }
  bool operator==(const ForceCurve&) const = default;

 private:
  std::size_t interval(double x) const;
  double area_from_first(double x) const;

  std::vector<Point> points_;
  std::vector<double> slopes_, areas_;  // at the points; from the first one
};

}  // namespace latsch::multibody
