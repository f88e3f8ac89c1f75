// SPDX-License-Identifier: Apache-2.0
// How fast a belt or a drum's surface runs: speed over time, straight between the points of a
// table, constant before the first and after the last; the way is its exact integral from t = 0.
#pragma once

#include <vector>

namespace latsch::road {

class Travel {
 public:
  struct Point {
    double time = 0.0;   // s
    double speed = 0.0;  // m/s
  };

  /// At rest.
  Travel() : Travel(0.0) {}
  /// At a constant speed, m/s.
  Travel(double speed);  // NOLINT: a speed is a travel
  /// `points` by time, which rises; at least one.
  explicit Travel(std::vector<Point> points);

  double speed(double time) const;     // m/s
  double distance(double time) const;  // m, since t = 0

 private:
  double from_first(double time) const;

  std::vector<Point> points_;
  std::vector<double> distances_;  // from the first point
  double at_zero_ = 0.0;           // that of t = 0
};

}  // namespace latsch::road
