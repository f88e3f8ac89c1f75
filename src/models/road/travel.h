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

  /// Makes the motion of a belt that does not move.
  Travel() : Travel(0.0) {}
  /// Makes a motion with constant speed, m/s.
  Travel(double speed);  // NOLINT: a speed is a travel
  /// Makes a motion from points in order of increasing time; at least one is required.
  explicit Travel(std::vector<Point> points);

  double speed(double time) const;     // m/s
  double distance(double time) const;  // m, since t = 0

 private:
  double from_first(double time) const;

  std::vector<Point> points_;
  std::vector<double> distances_;  // m, distance traveled from the first point to each point
  double at_zero_ = 0.0;           // m, distance traveled from the first point until t = 0
};

}  // namespace latsch::road
