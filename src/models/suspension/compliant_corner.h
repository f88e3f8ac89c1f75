// SPDX-License-Identifier: Apache-2.0
// A corner with any links as bodies on bushings, as loaded by a K&C rig. The inboard end of the
// push-rod is held, as on a rig that replaces the springs by rigid bars.
//
// A double wishbone has five bodies and ten bushings (double_wishbone.h). Five links are five rods;
// with the push-rod and the upright these are seven bodies on twelve bushings:
//
//   chassis ─ NAME_inner ─ link ─ NAME_outer ─ upright        of each link
//   chassis ─ pushrod_inner ─ push-rod ─ pushrod_outer ─ upright
//
// A rod between two ball joints would spin about its own axis; the rotational stiffness of its
// bushings holds it. Caster is that of a line fixed in the upright. At rest this is the kingpin;
// with five links it is the axis about which the rack turns the upright with the spring held.
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
  std::vector<multibody::Body> bodies;    // links and upright
  std::vector<multibody::Joint> joints;   // bushings, in the order of their names
  int upright = 0;                        // index; the origin of the body is the wheel center
  Eigen::Vector3d wheel_center, contact;  // m
  WheelPoints wheel;                      // points of the upright
};

/// Makes bodies and bushings of a double wishbone.
CompliantCorner compliant_corner(const DoubleWishbone& corner);

/// Returns NAME_inner, NAME_outer of every link, then pushrod_inner, pushrod_outer.
std::vector<std::string> joints_of_five_links(const CornerGeometry& geometry);
/// Takes bushings in the order of these names. The geometry must have no fault(), and its push-rod
/// must act on the upright. Returns a Failure if the rack does not steer the upright.
Result<CompliantCorner> compliant_five_links(const CornerGeometry& geometry,
                                             const Eigen::Vector3d& contact,
                                             const std::vector<BushingParameters>& bushings);

}  // namespace latsch::suspension
