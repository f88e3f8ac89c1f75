// SPDX-License-Identifier: Apache-2.0
// A corner with any links modeled as bodies on bushings, as a K&C rig (kinematics and compliance)
// loads it. The inboard end of the push-rod is held, as on a rig that replaces the springs by rigid
// bars.
//
// A double wishbone has five bodies and ten bushings (double_wishbone.h). Five links are five rods;
// with the push-rod and the upright these are seven bodies on twelve bushings:
//
//   chassis ─ NAME_inner ─ link ─ NAME_outer ─ upright        of each link
//   chassis ─ pushrod_inner ─ push-rod ─ pushrod_outer ─ upright
//
// A rod between two ball joints would spin about its own axis; the rotational stiffness of its
// bushings holds it. Caster is the angle of a line fixed in the upright. At rest this line is the
// kingpin. With five links it is the axis about which the rack turns the upright while the spring
// is held.
#pragma once

#include <Eigen/Core>
#include <string>
#include <vector>

#include "base/result.h"
#include "models/multibody/mechanism.h"
#include "models/suspension/corner_geometry.h"
#include "models/suspension/double_wishbone.h"
#include "models/suspension/wheel_position.h"

namespace latsch::suspension {

struct CompliantCorner {
  std::vector<multibody::Body> bodies;   // links and upright as bodies
  std::vector<multibody::Joint> joints;  // bushings, in the order of their names
  int upright = 0;  // index of the upright's body, whose origin is the wheel center
  Eigen::Vector3d wheel_center, contact;  // m
  WheelPoints wheel;                      // points of the upright whose positions are reported
};

/// Makes the bodies and bushings of a double-wishbone corner.
CompliantCorner compliant_corner(const DoubleWishbone& corner);

/// Returns the names of the bushings of a five-link corner: NAME_inner, NAME_outer of every link,
/// then pushrod_inner, pushrod_outer.
std::vector<std::string> joints_of_five_links(const CornerGeometry& geometry);
/// Makes the bodies and bushings of a five-link corner. `bushings` are in the order of
/// joints_of_five_links(). The geometry must have no fault(), and its push-rod must act on the
/// upright. Returns a Failure if the rack does not steer the upright.
Result<CompliantCorner> compliant_five_links(const CornerGeometry& geometry,
                                             const Eigen::Vector3d& contact,
                                             const std::vector<BushingParameters>& bushings);

}  // namespace latsch::suspension
