// SPDX-License-Identifier: Apache-2.0
// A port of a tire that responds to harmonic motions: where it is driven and observed.
#pragma once

#include <Eigen/Core>

namespace latsch::fe_tire {

/// A place and a direction in which a tire is driven (by a unit of what is named first) and
/// observed (by what is named second).
struct ResponsePort {
  enum class Of {
    point,   // force on a node of the tire, N; its displacement in space, m
    wheel,   // motion of the wheel, m or rad; force or moment of the tire on the rim, N or N m
    ground,  // motion of the ground, m or rad; force or moment of the ground on the tire
  };
  Of of = Of::point;
  int node = -1;  // index of a point among all nodes of the ring, section plane by section plane
  /// Unit vector in W: level with the ground, x in the heading of the wheel, z up.
  Eigen::Vector3d axis = Eigen::Vector3d::UnitZ();
  bool turns = false;  // true: the wheel or the ground turns about `axis` through the wheel center
};

}  // namespace latsch::fe_tire
