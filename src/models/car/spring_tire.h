// SPDX-License-Identifier: Apache-2.0
// The simplest tire: a vertical spring and damper at the point of the road below the wheel center.
//   Fz = k (R - (z - h)) + c (h' - z'),  never a pull;  h' along the wheel's path
// k is the stiffness, c the damping, R the free radius, z the height of the wheel center, h that of
// the road. The tire has no other forces. Linear car models use it.
#pragma once

#include <algorithm>

#include "models/tire/free_trials.h"
#include "models/tire/tire.h"

namespace latsch::car {

struct SpringTireParameters {
  double radius = 0.3;     // R, m
  double stiffness = 2e5;  // k, N/m
  double damping = 0.0;    // c, N s/m
};

class SpringTire final : public Tire {
 public:
  explicit SpringTire(const SpringTireParameters& parameters) : parameters_(parameters) {}

  double free_radius() const override { return parameters_.radius; }
  Result<HubForces> settle(const WheelMotion& motion,
                           const road::Road& road,
                           double time) override {
    WheelMotion standing = motion;
    standing.velocity.setZero();
    return advance(standing, road, time, 0.0);
  }
  Result<HubForces> advance(const WheelMotion& motion,
                            const road::Road& road,
                            double time,
                            double step) override {
    if (const Status fit = check_motion(motion, step); !fit) return fit.failure();
    const road::GroundPoint ground = road.at(motion.center.x(), motion.center.y(), time);
    const Eigen::Vector3d& n = ground.normal;
    const Eigen::Vector3d& v = motion.velocity;
    // Vertical velocity of the road at the moving contact point: h' = ∂h/∂t + v ∂h/∂x, from moving
    // ground and from the slope over which the tire rolls.
    const double rises = -(n.x() * v.x() + n.y() * v.y()) / n.z() + ground.velocity.dot(n) / n.z();
    const double force = std::max(
        0.0,
        parameters_.stiffness * (parameters_.radius - (motion.center.z() - ground.height)) +
            parameters_.damping * (rises - v.z()));
    return HubForces{motion.carrier.transpose() * Eigen::Vector3d(0.0, 0.0, force)};
  }
  Result<HubForces> advance_free(WheelMotion& motion,
                                 FreeWheel& wheel,
                                 const road::Road& road,
                                 double time,
                                 double step) override {
    return advance_by_trials(*this, motion, wheel, road, time, step);
  }
  std::unique_ptr<Tire> clone() const override { return std::make_unique<SpringTire>(*this); }

 private:
  SpringTireParameters parameters_;
};

}  // namespace latsch::car
