// SPDX-License-Identifier: Apache-2.0
#include "models/suspension/compliant_corner.h"

#include <cmath>

#include "models/multibody/rod_spin.h"
#include "models/suspension/kinematic_outputs.h"

namespace latsch::suspension {
namespace {

using Eigen::Vector3d;

std::vector<Link> rods_of(const CornerGeometry& geometry) {
  std::vector<Link> rods(geometry.linkage.links.begin(), geometry.linkage.links.end());
  rods.push_back({"pushrod", geometry.spring.inner, geometry.spring.outer});
  return rods;
}

/// Returns the direction of the kingpin at rest, pointing upward.
Result<Vector3d> kingpin_of(const CornerGeometry& geometry) {
  const auto rest = KinematicCorner(geometry, TravelOf::wheel_center).move_to(0.0, 0.0);
  if (!rest) return rest.failure();
  const double outboard = geometry.linkage.wheel.side == Side::left ? 1.0 : -1.0;
  return Vector3d(-std::tan(rest->caster), -outboard * std::tan(rest->kpi), 1.0);
}

}  // namespace

CompliantCorner compliant_corner(const DoubleWishbone& corner) {
  return {corner.bodies(),
          corner.joints(),
          DoubleWishbone::kUpright,
          corner.wheel_center,
          corner.contact,
          corner.wheel()};
}

std::vector<std::string> joints_of_five_links(const CornerGeometry& geometry) {
  std::vector<std::string> names;
  for (const Link& rod : rods_of(geometry))
    for (const char* end : {"_inner", "_outer"}) names.push_back(rod.name + end);
  return names;
}

Result<CompliantCorner> compliant_five_links(const CornerGeometry& geometry,
                                             const Vector3d& contact,
                                             const std::vector<BushingParameters>& bushings) {
  const auto kingpin = kingpin_of(geometry);
  if (!kingpin) return kingpin.failure();
  const Wheel& wheel = geometry.linkage.wheel;
  CompliantCorner corner;
  corner.wheel_center = wheel.center;
  corner.contact = contact;
  corner.wheel = {.contact = contact - wheel.center,
                  .center = Vector3d::Zero(),
                  .lower_ball_joint = Vector3d::Zero(),
                  .upper_ball_joint = *kingpin,
                  .side = wheel.side};
  corner.bodies.push_back({"the upright", wheel.center});
  const auto names = joints_of_five_links(geometry);
  for (const Link& rod : rods_of(geometry)) {
    const int body = static_cast<int>(corner.bodies.size());
    corner.bodies.push_back({"the link " + rod.name, 0.5 * (rod.inner + rod.outer)});
    const std::size_t i = corner.joints.size();
    corner.joints.push_back({names[i], multibody::kGround, body, rod.inner, bushings[i]});
    corner.joints.push_back({names[i + 1], body, corner.upright, rod.outer, bushings[i + 1]});
    multibody::hold_spin(corner.joints[i], corner.joints[i + 1]);
  }
  return corner;
}

}  // namespace latsch::suspension
