// SPDX-License-Identifier: Apache-2.0
#include "models/fe_tire/passage/wheel_on_plane.h"

#include <Eigen/Geometry>
#include <cmath>
#include <numbers>

namespace latsch::fe_tire {
namespace {

/// Cosine of the camber below which a wheel lies flat.
constexpr double kFlat = 0.3;
/// Length over which the plane of a road is taken, m, to each side.
constexpr double kAround = 0.1;

/// Returns `angle`, or the angle of the same direction that is nearest to `near`, rad.
double nearest_turn(double angle, double near) {
  constexpr double kTurn = 2.0 * std::numbers::pi;
  return angle + kTurn * std::round((near - angle) / kTurn);
}

}  // namespace

Result<WheelOnPlane> WheelOnPlane::of_motion(const WheelMotion& motion,
                                             const ReferencePlane& plane,
                                             const Eigen::Vector3d& ground,
                                             double time) {
  WheelOnPlane wheel;
  const Eigen::Vector3d e = motion.carrier.col(1), n = plane.axes.col(2);
  const double sine = e.dot(n), cosine = std::sqrt(std::max(0.0, 1.0 - sine * sine));
  if (!(cosine > kFlat)) return Failure{"the wheel lies flat on the road"};
  const Eigen::Vector3d ahead = e.cross(n).normalized(), left = n.cross(ahead);
  wheel.axes << ahead, e, ahead.cross(e);
  const Eigen::Vector3d at = plane.to_plane(motion.center);
  wheel.of.camber = std::asin(sine);
  wheel.of.height = at.z();
  wheel.place.way = at.head<2>();
  wheel.place.heading = std::atan2(ahead.dot(plane.axes.col(1)), ahead.dot(plane.axes.col(0)));
  wheel.place.time = time;
  wheel.velocity = motion.velocity;
  const Eigen::Vector3d over = motion.velocity - ground;
  wheel.of.speed = std::hypot(over.dot(ahead), over.dot(left));
  wheel.of.slip_angle = wheel.of.speed > 0.0 ? std::atan2(over.dot(left), over.dot(ahead)) : 0.0;
  wheel.more_spin = motion.angular_velocity.dot(left) / cosine;  // equation (V.6)
  const Eigen::Vector3d turning = motion.angular_velocity - wheel.more_spin * e;
  wheel.turning = wheel.axes.transpose() * turning;
  if (wheel.of.speed > 0.0) wheel.of.turn_slip = -turning.dot(n) / wheel.of.speed;
  wheel.of.spin = motion.spin_rate + wheel.more_spin;
  return wheel;
}

WheelMoment moment_between(const WheelOnPlane& from,
                           const WheelOnPlane& to,
                           double share,
                           double step) {
  WheelMoment moment;
  moment.of = between(from.of, to.of, share);
  moment.place.time = from.place.time + share * (to.place.time - from.place.time);
  moment.place.heading =
      from.place.heading +
      share * (nearest_turn(to.place.heading, from.place.heading) - from.place.heading);
  const Eigen::Vector3d acceleration = (to.velocity - from.velocity) / step;
  moment.acceleration = to.axes.transpose() * acceleration;
  moment.turning = from.turning + share * (to.turning - from.turning);
  moment.turning_rate = (to.turning - from.turning) / step;
  // The parabola through both ends with this acceleration.
  const double bow = 0.5 * step * step * (share * share - share);
  const double c = std::cos(to.of.camber), s = std::sin(to.of.camber);
  const Eigen::Vector3d level(moment.acceleration.x(),
                              c * moment.acceleration.y() - s * moment.acceleration.z(),
                              s * moment.acceleration.y() + c * moment.acceleration.z());
  moment.of.height += bow * level.z();
  const Eigen::Vector2d way =
      Eigen::Rotation2Dd(to.place.heading).toRotationMatrix() * level.head<2>();
  moment.place.way = from.place.way + share * (to.place.way - from.place.way) + bow * way;
  return moment;
}

ReferencePlane plane_below(const road::Road& road, const Eigen::Vector3d& center, double time) {
  const Eigen::Vector2d at = center.head<2>();
  Eigen::Vector3d normal = Eigen::Vector3d::UnitZ();
  double height = 0.0;
  for (int k = 0; k < 2; ++k) {
    const Eigen::Vector2d side = kAround * Eigen::Vector2d::Unit(k);
    const double before = road.mean_height(at - side, at, time);
    const double after = road.mean_height(at, at + side, time);
    normal[k] = -(after - before) / kAround;
    height += 0.25 * (before + after);
  }
  return ReferencePlane::through({at.x(), at.y(), height}, normal);
}

}  // namespace latsch::fe_tire
