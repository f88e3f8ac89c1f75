// SPDX-License-Identifier: Apache-2.0
// Kinematic outputs of a wheel at a travel and a position of the rack, with the same signs for left
// and right wheels. f is the horizontal direction in which the wheel points, l the horizontal
// direction outboard across it, a the spin axis to the left, v the velocity by travel, s = 1 left,
// -1 right:
//
//   steer = atan2(-a_x, a_y),  toe = -s steer,  camber = -s asin a_z                            (1)
//   kingpin k through g on the ground and h at the height of the wheel center w; contact point c:
//   caster = atan2(-k_x, k_z),  kpi = atan2(-s k_y, k_z)                                        (2)
//   caster_offset = (g - c)'f,  mechanical_trail = caster_offset cos caster                     (3)
//   caster_trail_hub = (w - h)'f,  scrub_radius = (c - g)'l,  kingpin_offset = (w - h)'l        (4)
//   roll_center_height = v_y / v_z c_y of the point of the upright at c                         (5)
//   motion_ratio = -dL/dz: compression of the spring per rise of the contact point              (6)
//   wheel_rate = k i² + F di/dz,  F = m g / i(0) + k (L(0) - L)                                 (7)
//   ride_rate = wheel_rate c_t / (wheel_rate + c_t),  ride_frequency = √(ride_rate / m) / 2π    (8)
//
// (2)-(4) are those printed by Lotus Suspension Analysis (verification/lotus_shark); the trail is
// measured at right angles to the kingpin, the offset along the ground. (5) is the height at which
// the normal to the path of the contact point meets the car's center plane. It is computed from the
// true motion of the upright, not by a geometric construction with planes. [Milliken & Milliken,
// Race Car Vehicle Dynamics, 1995]
#pragma once

#include <span>
#include <string>

#include "base/result.h"
#include "models/suspension/corner_geometry.h"
#include "models/suspension/sign_views.h"

namespace latsch::suspension {

struct WheelKinematics {
  double contact_x, contact_y, contact_z, center_x, center_y, center_z;
  double toe, steer, camber, caster, kpi;
  double caster_offset, mechanical_trail, caster_trail_hub, scrub_radius, kingpin_offset;
  double bump_steer, bump_camber;
  double contact_x_by_travel, contact_y_by_travel, contact_z_by_travel;
  double center_x_by_travel, center_y_by_travel, center_z_by_travel;
  double steer_by_rack, camber_by_rack;
  double roll_center_height, roll_center_by_travel;
  double spring_length, motion_ratio, motion_ratio_by_travel;
  double arb_angle, arb_ratio;
  double wheel_rate, ride_rate, ride_frequency;  // 0 if spring rate or mass are not known
};

struct KinematicOutput {
  const char* name;
  const char* unit;   // SI
  const char* words;  // description of the output and of its positive sense
  double WheelKinematics::*value;
  Sense of = Sense::same, by = Sense::same;
  enum class Group { wheel, spring, bar, rates } group = Group::wheel;
};

/// Returns all kinematic outputs in the order in which they are shown.
std::span<const KinematicOutput> kinematic_outputs();

/// A corner that moves from its position at rest. The geometry must have no fault() and must
/// outlive this object.
class KinematicCorner {
 public:
  KinematicCorner(const CornerGeometry& geometry, TravelOf of);
  Result<WheelKinematics> move_to(double travel, double rack);
  const MovingLinkage& linkage() const { return moving_; }

 private:
  const CornerGeometry* geometry_;
  MovingLinkage moving_;
  Status rest_;  // a Failure if the linkage has no position at rest
  double length_at_rest_ = 0.0, ratio_at_rest_ = 0.0;
};

/// Returns the outputs of the mirror-image wheel, whose rack is displaced in the opposite
/// direction.
WheelKinematics mirrored(const WheelKinematics& wheel);

}  // namespace latsch::suspension
