// SPDX-License-Identifier: Apache-2.0
// The contact patch between tread and ground: its size and the tractions at its points.
#pragma once

#include <vector>

namespace latsch::fe_tire {

/// Contact patch: extent and contact points, in the axes of the ground.
struct ContactPatch {
  double length = 0.0, width = 0.0;  // m, extent along the ground's x and y
  double area = 0.0;                 // m^2
  struct Point {
    double x, y;              // m, relative to the point below the wheel center
    double pressure;          // Pa
    double shear_x, shear_y;  // Pa, shear traction on the tire
    double area;              // m^2, area that the point represents
    double length;            // m, length of that area along the road
    bool sticks;
  };
  std::vector<Point> points;
};

}  // namespace latsch::fe_tire
