// SPDX-License-Identifier: Apache-2.0
#include "models/ring_tire/belt/rim_frame.h"

#include <cmath>
#include <numbers>

namespace latsch::ring_tire {

RimFrame RimFrame::of(const WheelMotion& motion) {
  const Eigen::Vector3d x = motion.carrier.col(0), a = motion.carrier.col(1),
                        z = motion.carrier.col(2);
  const double c = std::cos(motion.spin), s = std::sin(motion.spin);
  RimFrame rim;
  rim.center = motion.center;
  rim.X = c * x - s * z;
  rim.a = a;
  rim.Z = s * x + c * z;
  rim.velocity = motion.velocity;
  rim.angular_velocity = motion.angular_velocity + motion.spin_rate * a;
  rim.spin_rate = motion.spin_rate;
  return rim;
}

NodeAngles::NodeAngles(int nodes)
    : sine_(static_cast<std::size_t>(nodes)), cosine_(static_cast<std::size_t>(nodes)) {
  for (int k = 0; k < nodes; ++k) {
    const double phi = 2.0 * std::numbers::pi * k / nodes;
    sine_[static_cast<std::size_t>(k)] = std::sin(phi);
    cosine_[static_cast<std::size_t>(k)] = std::cos(phi);
  }
}

}  // namespace latsch::ring_tire
