// SPDX-License-Identifier: Apache-2.0
#include "models/suspension/spring_drive.h"

#include <fmt/format.h>

#include <Eigen/Geometry>
#include <cmath>

#include "models/suspension/plausible_points.h"

namespace latsch::suspension {
namespace {

using Eigen::Matrix;
using Eigen::Vector3d;
using Velocities = Matrix<double, 3, 2>;  // columns: derivatives by wheel travel and by rack travel

// Smallest distance of a rod from the rocker's axis at which it can turn the rocker, m.
constexpr double kNoArm = 1e-3;
constexpr double kPastReach = 1e-9;  // amount by which rounding may raise a cosine above 1 at rest

struct Moved {
  Vector3d place;
  Velocities velocities;
};

Vector3d from_axis(const Vector3d& axis, const Vector3d& v) { return v - v.dot(axis) * axis; }

Moved on_upright(const Vector3d& point,
                 const Vector3d& center,
                 const Pose& upright,
                 const Twists& twists) {
  const Vector3d arm = upright.turn * (point - center);
  Moved moved{upright.place + arm, {}};
  moved.velocities.col(0) = Twists::at(twists.by_travel, arm);
  moved.velocities.col(1) = Twists::at(twists.by_rack, arm);
  return moved;
}

/// Returns position and velocity of the push-rod's point on a wishbone whose ball joint has this
/// position and velocity.
Moved on_wishbone(const SpringDrive& drive, const Moved& ball) {
  const Vector3d axis = (drive.hinge_rear - drive.hinge_front).normalized();
  const Vector3d was = drive.ball - drive.hinge_front, is = ball.place - drive.hinge_front;
  const double angle =
      std::atan2(axis.dot(was.cross(is)), from_axis(axis, was).dot(from_axis(axis, is)));
  const Vector3d arm =
      Eigen::AngleAxisd(angle, axis).toRotationMatrix() * (drive.outer - drive.hinge_front);
  // Derivative of the ball joint's position by the wishbone's angle.
  const Vector3d lever = axis.cross(is);
  Moved moved{drive.hinge_front + arm, {}};
  moved.velocities = axis.cross(arm) * (lever.transpose() * ball.velocities) / lever.squaredNorm();
  return moved;
}

Moved driven_end(const SpringDrive& drive,
                 const Vector3d& center,
                 const Pose& upright,
                 const Twists& twists) {
  if (drive.on == SpringDrive::On::upright) return on_upright(drive.outer, center, upright, twists);
  return on_wishbone(drive, on_upright(drive.ball, center, upright, twists));
}

std::string in_one_place(const Vector3d& a,
                         const Vector3d& b,
                         const char* first,
                         const char* last) {
  if ((a - b).norm() > kNear) return {};
  return fmt::format("{} and {} coincide", first, last);
}

}  // namespace

std::string Lever::fault() const {
  if ((own - driving).norm() < kNear) return fmt::format("both ends of the {} coincide", rod);
  if (from_axis(axis, own - pivot).norm() < kNear)
    return fmt::format("the {} ends on the axis of the {}: it has no arm", rod, name);
  const Vector3d n = (driving - own).normalized();
  if (std::abs(n.dot(axis.cross(own - pivot))) < kNoArm)
    return fmt::format("the {} points through the axis of the {} and turns nothing", rod, name);
  return {};
}

Vector3d Lever::at(double angle, const Vector3d& point) const {
  return pivot + Eigen::AngleAxisd(angle, axis).toRotationMatrix() * (point - pivot);
}

Result<Lever::Turned> Lever::turned(const Vector3d& driving_now) const {
  const Vector3d u = own - pivot, w = driving_now - pivot, across = axis.cross(u);
  const double along = axis.dot(u) * axis.dot(w);
  const double a = w.dot(u) - along, b = w.dot(across);
  const double d =
      0.5 * (u.squaredNorm() + w.squaredNorm() - (own - driving).squaredNorm()) - along;
  const double size = std::hypot(a, b);
  if (!(std::abs(d) <= size * (1.0 + kPastReach)))
    return Failure{fmt::format("the {} does not reach the {}: it is {:.3g} mm too {}",
                               rod,
                               name,
                               1e3 * (std::abs(d) - size) / (own - driving).norm(),
                               d > 0.0 ? "short" : "long")};
  // The equation has the two solutions atan2(b, a) ± acos(d / size). The sign is chosen such that
  // the angle is 0 at rest; it is opposite to that of b at rest.
  const double sign = (driving - pivot).dot(across) > 0.0 ? -1.0 : 1.0;
  const double ratio = std::max(-1.0, std::min(1.0, d / size));
  const double angle = std::remainder(std::atan2(b, a) + sign * std::acos(ratio), 2.0 * M_PI);
  const Vector3d end = at(angle, own), n = (driving_now - end).normalized();
  return Turned{angle, n / n.dot(axis.cross(end - pivot))};
}

std::string SpringDrive::fault() const {
  if (!rocker) return in_one_place(outer, inner, "pushrod_outer", "pushrod_inner");
  if (std::string fault = rocker->lever.fault(); !fault.empty()) return fault;
  if (std::string fault = in_one_place(
          rocker->spring_end, rocker->spring_on_chassis, "rocker_damper", "damper_chassis");
      !fault.empty())
    return fault;
  return blade ? blade->fault() : std::string{};
}

Result<RodEnds> rod_ends(const SpringDrive& drive,
                         const Vector3d& wheel_center_at_rest,
                         const Pose& upright) {
  const Twists held = {Vector6d::Zero(), Vector6d::Zero()};
  const Vector3d outer = driven_end(drive, wheel_center_at_rest, upright, held).place;
  if (!drive.rocker) return RodEnds{outer, drive.inner};
  const Lever& rocker = drive.rocker->lever;
  const auto turned = rocker.turned(outer);
  if (!turned) return turned.failure();
  return RodEnds{outer, rocker.at(turned->angle, rocker.own)};
}

Result<SpringState> spring_state(const SpringDrive& drive,
                                 const Vector3d& wheel_center_at_rest,
                                 const Pose& upright,
                                 const Twists& twists) {
  const Moved end = driven_end(drive, wheel_center_at_rest, upright, twists);
  if (!drive.rocker) {
    const Vector3d d = end.place - drive.inner;
    return SpringState{.length = d.norm(),
                       .length_slopes = end.velocities.transpose() * d.normalized()};
  }
  const Lever& rocker = drive.rocker->lever;
  const auto turned = rocker.turned(end.place);
  if (!turned) return turned.failure();
  const Eigen::Vector2d by_angle = end.velocities.transpose() * turned->by_driving;
  const auto velocity = [&](const Vector3d& place) -> Vector3d {
    return rocker.axis.cross(place - rocker.pivot);
  };
  const Vector3d spring_end = rocker.at(turned->angle, drive.rocker->spring_end);
  const Vector3d d = spring_end - drive.rocker->spring_on_chassis;
  SpringState state{.length = d.norm(),
                    .length_slopes = d.normalized().dot(velocity(spring_end)) * by_angle};
  if (!drive.blade) return state;
  const Vector3d link = rocker.at(turned->angle, drive.blade->driving);
  const auto blade = drive.blade->turned(link);
  if (!blade) return blade.failure();
  state.blade_angle = blade->angle;
  state.blade_slopes = blade->by_driving.dot(velocity(link)) * by_angle;
  return state;
}

}  // namespace latsch::suspension
