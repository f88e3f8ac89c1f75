// SPDX-License-Identifier: Apache-2.0
// Speed of a belt or of a drum's surface over time: linear between the points of a table, constant
// before the first and after the last. The distance is its exact integral from t = 0.
#pragma once

#include <vector>

namespace latsch::road {

class Travel {
 public:
  struct Point {
    double time = 0.0;   // s
    double speed = 0.0;  // m/s
  };

  /// Makes a belt at rest.
  Travel() : Travel(0.0) {}
  /// Makes a constant speed, m/s.
  Travel(double speed);  // NOLINT: a speed is a travel
  /// Takes `points` in order of increasing time; at least one.
  explicit Travel(std::vector<Point> points);

  double speed(double time) const;     // m/s
  double distance(double time) const;  // m, since t = 0

 private:
  double from_first(double time) const;

  std::vector<Point> points_;
  std::vector<double> distances_;  // distance from the first point
  double at_zero_ = 0.0;           // distance from the first point at t = 0
};

}  // namespace latsch::road
