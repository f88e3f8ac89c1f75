// SPDX-License-Identifier: Apache-2.0
// The contact patch of tread and ground.
#pragma once

#include <vector>

namespace latsch::fe_tire {

/// Contact patch in axes of the ground.
struct ContactPatch {
  double length = 0.0, width = 0.0;  // m, extent along x and y
  double area = 0.0;                 // m^2
  struct Point {
    double x, y;              // m, from the point below the wheel center
    double pressure;          // Pa
    double shear_x, shear_y;  // Pa, on the tire
    double area;              // m^2 that the point represents
    double length;            // m, length of that area along the road
    bool sticks;
  };
  std::vector<Point> points;
};

}  // namespace latsch::fe_tire
