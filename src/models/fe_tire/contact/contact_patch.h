// SPDX-License-Identifier: Apache-2.0
// Where tread and ground touch, and what a sensor on the ground shows of it.
//
// A node's pressure is a mean weighted by its hat (T.1), of which the share of the surface that it
// stands for, L long, knows only the force. Spread evenly over that share the force lies too close
// to the node, spread by the hat, which reaches to the neighbors, too far from it where these do
// not touch. Between them a trapezoid, the even share averaged over b,
//   b = L / sqrt(2),   its second moment (L^2 + b^2) / 12,                                    (P.1)
// is midway between the even share, L^2 / 12, and the hat, L^2 / 6, as half the sag is what counts
// of a mean in (T.2). Along the road and across.
#pragma once

#include <vector>

namespace latsch::fe_tire {

/// Axes of the ground.
struct ContactPatch {
  double length = 0.0, width = 0.0;  // m, extent along x and y
  double area = 0.0;                 // m^2
  struct Point {
    double x, y;              // m, from the point below the wheel center
    double pressure;          // Pa
    double shear_x, shear_y;  // Pa, on the tire
    double area;              // m^2 that it stands for
    double length;            // m of it along the road
    bool sticks;
  };
  std::vector<Point> points;

  /// Pa, mean on a square sensor of side (m) around x, y.
  double mean_pressure(double x, double y, double side) const;
  /// The highest of it, wherever the sensor lies: searched in steps of a sixth of it.
  double peak_pressure(double side) const;
};

}  // namespace latsch::fe_tire
