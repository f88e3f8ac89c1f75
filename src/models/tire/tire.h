// SPDX-License-Identifier: Apache-2.0
// One interface for the tires that roll: motion of the wheel and road in, force on the hub out.
//
// Frames: inertial with z up; TYDEX C at the wheel center (x forward, y along the spin axis to the
// left, z up in the wheel plane; does not spin). Signs as in NOTATION.md.
#pragma once

#include <Eigen/Core>
#include <cmath>
#include <memory>
#include <optional>
#include <string>

#include "base/result.h"
#include "models/road/road.h"
#include "models/tire/footprint.h"

namespace latsch {

/// Where the rim is and how it moves.
struct WheelMotion {
  Eigen::Vector3d center = Eigen::Vector3d::Zero();            // m, inertial
  Eigen::Matrix3d carrier = Eigen::Matrix3d::Identity();       // columns: axes of C, inertial
  Eigen::Vector3d velocity = Eigen::Vector3d::Zero();          // m/s, of the center, inertial
  Eigen::Vector3d angular_velocity = Eigen::Vector3d::Zero();  // rad/s, of C, inertial
  double spin = 0.0;       // rad, of the rim about the carrier's y; rolling forward: positive rate
  double spin_rate = 0.0;  // rad/s

  bool operator==(const WheelMotion&) const = default;
};

/// Empty, or why no tire can follow: a number that is none, a step (s) back in time.
inline std::string trouble_with(const WheelMotion& motion, double step = 0.0) {
  if (!(motion.center.allFinite() && motion.carrier.allFinite() && motion.velocity.allFinite() &&
        motion.angular_velocity.allFinite() && std::isfinite(motion.spin) &&
        std::isfinite(motion.spin_rate)))
    return "the wheel's motion is not finite";
  return step >= 0.0 && std::isfinite(step) ? "" : "a step of the tire needs a time of 0 or more";
}

/// What the tire does to the rim at the wheel center, in C.
struct HubForces {
  Eigen::Vector3d force = Eigen::Vector3d::Zero();   // N
  Eigen::Vector3d moment = Eigen::Vector3d::Zero();  // N m
};

struct FreeWheel;

/// A tire in motion: it remembers its state from one step to the next.
class Tire {
 public:
  virtual ~Tire() = default;

  /// m; of the unloaded tire at rest: where first touch is.
  virtual double free_radius() const = 0;
  /// Brings the tire to rest in equilibrium with the rim standing (velocities taken as zero).
  virtual Result<HubForces> settle(const WheelMotion& motion,
                                   const road::Road& road,
                                   double time) = 0;
  /// Goes on from the last state to `motion`, `step` seconds later, `time` being the end of the
  /// step.
  virtual Result<HubForces> advance(const WheelMotion& motion,
                                    const road::Road& road,
                                    double time,
                                    double step) = 0;
  /// The same with a wheel whose spin or height follows what acts on it (free_wheel.h), solved with
  /// the step; `wheel` and what is free of `motion` become those at its end. A Failure leaves the
  /// tire and both as they were.
  virtual Result<HubForces> advance_free(
      WheelMotion& motion, FreeWheel& wheel, const road::Road& road, double time, double step) = 0;
  /// As it stood on the road at the end of settle() or of the last step; nothing of a kind of tire
  /// that does not know.
  virtual std::optional<Footprint> footprint() const { return std::nullopt; }
  /// m, inertial: points around its belt as it stands, in order; none of a kind that has no belt.
  virtual Eigen::Matrix3Xd outline() const { return {}; }
  /// An independent copy of model and state.
  virtual std::unique_ptr<Tire> clone() const = 0;
};

}  // namespace latsch
