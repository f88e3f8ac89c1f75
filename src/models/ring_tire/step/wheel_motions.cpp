// SPDX-License-Identifier: Apache-2.0
#include "models/ring_tire/step/wheel_motions.h"

#include <fmt/format.h>

#include <Eigen/Geometry>

namespace latsch::ring_tire {

WheelMotion between(const WheelMotion& from, const WheelMotion& to, double share) {
  const auto mix = [&](const auto& a, const auto& b) {
    return ((1.0 - share) * a + share * b).eval();
  };
  WheelMotion motion;
  motion.center = mix(from.center, to.center);
  motion.velocity = mix(from.velocity, to.velocity);
  motion.angular_velocity = mix(from.angular_velocity, to.angular_velocity);
  motion.carrier = Eigen::Quaterniond(from.carrier)
                       .slerp(share, Eigen::Quaterniond(to.carrier))
                       .toRotationMatrix();
  motion.spin = (1.0 - share) * from.spin + share * to.spin;
  motion.spin_rate = (1.0 - share) * from.spin_rate + share * to.spin_rate;
  return motion;
}

WheelMotion moved(const WheelMotion& motion, int column, double by) {
  WheelMotion to = motion;
  if (column < kByRotation)
    to.center[column - kByCenter] += by;
  else if (column < kByVelocity)
    to.carrier =
        Eigen::AngleAxisd(by, Eigen::Vector3d::Unit(column - kByRotation)) * motion.carrier;
  else if (column < kByAngularVelocity)
    to.velocity[column - kByVelocity] += by;
  else if (column < kBySpin)
    to.angular_velocity[column - kByAngularVelocity] += by;
  else
    (column == kBySpin ? to.spin : to.spin_rate) += by;
  return to;
}

double difference_step(int column, double step) {
  constexpr double kPlace = 1e-7, kRadius = 0.3;  // m
  const bool turns =
      (column >= kByRotation && column < kByVelocity) || column >= kByAngularVelocity;
  const bool rate = (column >= kByVelocity && column < kBySpin) || column == kBySpinRate;
  return kPlace / (turns ? kRadius : 1.0) / (rate ? step : 1.0);
}

Status check_step(const WheelMotion& motion, double step) {
  constexpr double kLongest = 1000.0;  // s
  if (!(step > 0.0 && step <= kLongest))
    return Failure{fmt::format("a step of the ring needs a time above 0 and up to {} s", kLongest)};
  return check_motion(motion, step);
}

}  // namespace latsch::ring_tire
