// SPDX-License-Identifier: Apache-2.0
// Mass, center and inertia of a part whose mass is spread evenly over straight rods between points,
// as in a push-rod and nearly in a wishbone.
//   inertia of a rod (solid cylinder) about its middle: along it m r²/2, across it m (L²/12 + r²/4)
#pragma once

#include <Eigen/Core>
#include <utility>
#include <vector>

namespace latsch::multibody {

struct BodyMass {
  double mass = 0.0;                                  // kg
  Eigen::Vector3d center = Eigen::Vector3d::Zero();   // m
  Eigen::Matrix3d inertia = Eigen::Matrix3d::Zero();  // about the center of mass, kg m^2
};

/// Returns the mass properties of straight rods. `rods`: end points, m; `radius`: r, m.
BodyMass mass_of_rods(const std::vector<std::pair<Eigen::Vector3d, Eigen::Vector3d>>& rods,
                      double mass,
                      double radius);

/// Combines both masses to one rigid body.
BodyMass together(const BodyMass& a, const BodyMass& b);

}  // namespace latsch::multibody
