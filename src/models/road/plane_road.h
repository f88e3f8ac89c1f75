// SPDX-License-Identifier: Apache-2.0
// An infinite plane as road: flat, with a grade, or a moving flat belt.
#pragma once

#include "models/road/road.h"
#include "models/road/travel.h"

namespace latsch::road {

class PlaneRoad final : public Road {
 public:
  /// Height, slopes and motion of the plane.
  struct Settings {
    double height = 0.0;    // m, height at the origin
    double grade = 0.0;     // slope dz/dx: positive if the road rises ahead
    double bank = 0.0;      // slope dz/dy: positive if the road rises to the left
    double friction = 1.0;  // factor
    /// Speed of the belt: it carries the ground backward, toward -x, below a standing tire.
    Travel belt = {};
  };

  /// Makes a level plane at the height zero that does not move.
  PlaneRoad() : PlaneRoad(Settings{}) {}
  /// Makes a plane with these settings.
  explicit PlaneRoad(const Settings& settings);

  GroundPoint at(double x, double y, double time) const override;
  double height(double x, double y, double time) const override;
  GroundBounds bounds(const GroundBox& box, double time) const override;

 private:
  Settings settings_;
  Eigen::Vector3d normal_;
  Eigen::Vector3d forward_;  // unit vector along the plane whose projection is x
};

}  // namespace latsch::road
