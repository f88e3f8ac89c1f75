// SPDX-License-Identifier: Apache-2.0
// Mechanism by which a wheel moves the spring of its corner: directly from a wishbone or the
// upright, or through a push-rod (or pull-rod) and a rocker, which may also move the blade of an
// anti-roll bar. All rods have constant length.
//
//   wishbone:  hinged on its axis; turned by the angle of its ball joint
//   rocker:    turned by φ about an axis through its pivot, so that |o - i(φ)| = l, the length of
//              the push-rod with the ends o (at the wheel) and i (on the rocker):
//              with u = i - pivot at rest, w = o - pivot, e the axis:
//              a cos φ + b sin φ = d,   a = w'u - (e'u)(e'w),  b = w'(e × u),
//              d = (u'u + w'w - l²)/2 - (e'u)(e'w),
//              using the one of two solutions that is φ = 0 at rest
//   blade:     turned like the rocker, driven by its link from the rocker
//
// Slopes by travel and rack follow from the twist of the upright: v'n is equal at both ends of a
// rod with direction n.
#pragma once

#include <Eigen/Core>
#include <optional>
#include <string>

#include "base/result.h"
#include "models/suspension/linkage.h"

namespace latsch::suspension {

/// A body that rotates about a fixed axis and is driven by a rod to one of its points. Points are
/// those at rest, m.
struct Lever {
  std::string name, rod;
  Eigen::Vector3d pivot, axis = Eigen::Vector3d::UnitY();  // unit length
  Eigen::Vector3d own, driving;  // ends of the rod: on the lever, and on the part that drives it

  /// Returns a message that says what is wrong with the lever, or an empty text.
  std::string fault() const;
  /// Angle of the lever, and its derivative with respect to the position of the rod's driving end.
  struct Turned {
    double angle;
    Eigen::Vector3d by_driving;
  };
  Result<Turned> turned(const Eigen::Vector3d& driving_now) const;
  Eigen::Vector3d at(double angle, const Eigen::Vector3d& point) const;
};

struct SpringDrive {
  enum class On { upper_wishbone, lower_wishbone, upright };

  On on = On::upright;
  // Ends of the push-rod, m; without a rocker these are the ends of the spring.
  Eigen::Vector3d outer, inner;
  /// Points of the wishbone on which the push-rod acts, m: the two ends of its axis on the chassis,
  /// and its ball joint.
  Eigen::Vector3d hinge_front, hinge_rear, ball;
  struct Rocker {
    Lever lever;
    Eigen::Vector3d spring_end, spring_on_chassis;  // m
  };
  std::optional<Rocker> rocker;
  /// Blade of the anti-roll bar. The rod that drives it starts at the rocker.
  std::optional<Lever> blade;

  std::string fault() const;
};

/// State of the spring. Slopes are derivatives by wheel travel and by rack travel.
struct SpringState {
  double length;                  // m, distance between the ends of the spring
  Eigen::Vector2d length_slopes;  // 1
  double blade_angle = 0.0;       // rad
  Eigen::Vector2d blade_slopes = Eigen::Vector2d::Zero();  // rad/m
};

/// Ends of the push-rod in a pose of the upright, m; without a rocker, those of the spring.
struct RodEnds {
  Eigen::Vector3d outer, inner;
};
Result<RodEnds> rod_ends(const SpringDrive& drive,
                         const Eigen::Vector3d& wheel_center_at_rest,
                         const Pose& upright);

Result<SpringState> spring_state(const SpringDrive& drive,
                                 const Eigen::Vector3d& wheel_center_at_rest,
                                 const Pose& upright,
                                 const Twists& twists);

}  // namespace latsch::suspension
