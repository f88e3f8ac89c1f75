// SPDX-License-Identifier: Apache-2.0
// An infinite plane: the flat road, a grade, or a running flat belt.
#pragma once

#include "models/road/road.h"
#include "models/road/travel.h"

namespace latsch::road {

class PlaneRoad final : public Road {
 public:
  /// Height, slopes and motion of the plane.
  struct Settings {
    double height = 0.0;    // m, at the origin
    double grade = 0.0;     // dz/dx: rises ahead
    double bank = 0.0;      // dz/dy: rises to the left
    double friction = 1.0;  // factor
    Travel belt = {};       // down the x direction: carries the ground backward below a standing
                            // tire
  };

  /// Makes a level plane at zero, at rest.
  PlaneRoad() : PlaneRoad(Settings{}) {}
  /// A plane of these settings.
  explicit PlaneRoad(const Settings& settings);

  GroundPoint at(double x, double y, double time) const override;
  double height(double x, double y, double time) const override;
  GroundBounds bounds(const GroundBox& box, double time) const override;

 private:
  Settings settings_;
  Eigen::Vector3d normal_;
  Eigen::Vector3d forward_;  // unit vector, up the grade along x
};

}  // namespace latsch::road
