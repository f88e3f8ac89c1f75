// SPDX-License-Identifier: Apache-2.0
// What a tire asks a road: height, normal and friction of the ground below a point, and how fast
// the ground moves there (belt and drum rigs move the road under a standing tire).
#pragma once

#include <Eigen/Core>

namespace latsch::road {

/// The ground below one point. Inertial frame, z up.
struct GroundPoint {
  double height = 0.0;                                 // m
  Eigen::Vector3d normal = Eigen::Vector3d::UnitZ();   // unit, upward
  double friction = 1.0;                               // factor on the tire's own friction
  Eigen::Vector3d velocity = Eigen::Vector3d::Zero();  // m/s, of the ground's material
};

class Road {
 public:
  virtual ~Road() = default;

  /// x, y in m, `time` in s. Defined for every finite x, y: a road continues beyond its data in a
  /// way its class names. Const and without locks: many threads may ask one road.
  virtual GroundPoint at(double x, double y, double time) const = 0;
  /// The height alone, m, bit for bit that of `at`: what enveloping and contact search ask most.
  virtual double height(double x, double y, double time) const { return at(x, y, time).height; }
};

}  // namespace latsch::road
