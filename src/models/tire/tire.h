// SPDX-License-Identifier: Apache-2.0
// Interface of tires that roll. Inputs are the wheel's motion and the road, output is the force on
// the hub.
//
// Frames: inertial with z up; TYDEX C at the wheel center (x forward, y along the spin axis to the
// left, z up in the wheel plane; does not spin). Signs as in NOTATION.md.
#pragma once

#include <Eigen/Core>
#include <cmath>
#include <memory>
#include <optional>

#include "base/result.h"
#include "models/road/road.h"
#include "models/tire/footprint.h"

namespace latsch {

/// Position and motion of the rim.
struct WheelMotion {
  Eigen::Vector3d center = Eigen::Vector3d::Zero();  // m, inertial
  /// Columns: axes of the frame C in the inertial frame.
  Eigen::Matrix3d carrier = Eigen::Matrix3d::Identity();
  Eigen::Vector3d velocity = Eigen::Vector3d::Zero();  // m/s, of the center, in the inertial frame
  /// Angular velocity of the frame C, in the inertial frame, rad/s.
  Eigen::Vector3d angular_velocity = Eigen::Vector3d::Zero();
  /// Rotation of the rim about the carrier's y, rad; its rate is positive when the wheel rolls
  /// forward.
  double spin = 0.0;
  double spin_rate = 0.0;  // rad/s

  bool operator==(const WheelMotion&) const = default;
};

/// Returns a Failure if a motion is impossible for any tire: a number that is not finite, or a
/// negative step (s).
inline Status check_motion(const WheelMotion& motion, double step = 0.0) {
  if (!(motion.center.allFinite() && motion.carrier.allFinite() && motion.velocity.allFinite() &&
        motion.angular_velocity.allFinite() && std::isfinite(motion.spin) &&
        std::isfinite(motion.spin_rate)))
    return Failure{"the wheel's motion is not finite"};
  if (!(step >= 0.0 && std::isfinite(step)))
    return Failure{"a step of the tire needs a time of 0 or more"};
  return {};
}

/// Force and moment of the tire on the rim at the wheel center, in the axes of the frame C.
struct HubForces {
  Eigen::Vector3d force = Eigen::Vector3d::Zero();   // N
  Eigen::Vector3d moment = Eigen::Vector3d::Zero();  // N m
};

struct FreeWheel;

/// A tire in motion, which stores its state from one step to the next.
class Tire {
 public:
  virtual ~Tire() = default;

  /// Radius of the unloaded tire at rest, m, which determines the height of first touch.
  virtual double free_radius() const = 0;
  /// Brings the tire to equilibrium while the rim is at rest. The velocities of `motion` are taken
  /// as zero.
  virtual Result<HubForces> settle(const WheelMotion& motion,
                                   const road::Road& road,
                                   double time) = 0;
  /// Advances the tire from its last state to `motion`, which is reached `step` seconds later.
  /// `time` is the end of the step, s.
  virtual Result<HubForces> advance(const WheelMotion& motion,
                                    const road::Road& road,
                                    double time,
                                    double step) = 0;
  /// Advances the tire together with a wheel whose spin or height follows from the forces on it
  /// (free_wheel.h). On return, `wheel` and the free components of `motion` hold their values at
  /// the end of the step. A Failure leaves the tire, `wheel` and `motion` unchanged.
  virtual Result<HubForces> advance_free(
      WheelMotion& motion, FreeWheel& wheel, const road::Road& road, double time, double step) = 0;
  /// Returns the footprint at the end of settle() or of the last step, or nothing for tire models
  /// without one.
  virtual std::optional<Footprint> footprint() const { return std::nullopt; }
  /// Returns the load of the road on the tire at the end of settle() or of the last step, N; 0 if
  /// the tire does not touch the road, nullopt if the load is not known.
  virtual std::optional<double> road_load() const {
    const auto print = footprint();
    return print ? std::optional(print->load) : std::nullopt;
  }
  /// Returns true if the first step of a wheel that rolls ends in the steady state of its motion,
  /// so that the tire needs no way to roll in.
  virtual bool starts_steadily() const { return false; }
  /// Returns points along the belt in its current position, in circumferential order, m, in the
  /// inertial frame. Returns none for tire models without a belt.
  virtual Eigen::Matrix3Xd outline() const { return {}; }
  /// Returns an independent copy of the tire with its state.
  virtual std::unique_ptr<Tire> clone() const = 0;
};

}  // namespace latsch
