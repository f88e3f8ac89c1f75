// SPDX-License-Identifier: Apache-2.0
// A wheel at the end of a step of a tire that rolls in time, and the forces found there.
#pragma once

#include <Eigen/Core>
#include <optional>
#include <vector>

#include "base/result.h"
#include "models/fe_tire/grip/passing_ground.h"
#include "models/fe_tire/rolling/rolling_case.h"

namespace latsch::fe_tire {

/// A wheel that spins freely, or under a moment besides that of the tire.
struct SpinningWheel {
  double inertia = 1.0;  // kg m^2, of all that spins but the tire
  double moment = 0.0;   // N m, about +y, at the end of the step
  /// Derivative of the moment by the spin, N m s, about the spin `by_spin_at`, rad/s.
  double by_spin = 0.0, by_spin_at = 0.0;
  double brake = 0.0;  // N m, largest moment of dry friction against the spin

  /// Returns the sum of all moments but the tire's at this spin, with `of_tire` that of the tire.
  double sum(double spin, double of_tire) const;
};

/// The wheel at the end of a step.
struct WheelMoment {
  RollingCase of;  // load and drive are not used
  /// Ground that is not smooth, for this step; it is seen from `place`, and in parts of the step
  /// from between the last place and this one.
  const PassingGround* ground = nullptr;
  WheelPlace place = {};
  Eigen::Vector3d acceleration = Eigen::Vector3d::Zero();  // m/s^2, of the center, wheel axes
  /// Rotation of the wheel's axes (not of the wheel in them), rad/s, and its rate, rad/s^2, in the
  /// wheel's axes. Their part about the vertical turns the ground below the wheel as well, which
  /// `of.turn_slip` states.
  Eigen::Vector3d turning = Eigen::Vector3d::Zero(), turning_rate = Eigen::Vector3d::Zero();
  /// Set: the spin of `of` is not used, it follows from the moments.
  std::optional<SpinningWheel> wheel = {};
  /// Set: the ground rises below the wheel until it carries this load, N; the height of `of` is a
  /// start.
  std::optional<double> load = {};
};

/// Forces of the tire at the end of a step.
struct TransientForces {
  Eigen::Vector3d force = Eigen::Vector3d::Zero();   // N, on the hub, axes of the wheel (TYDEX C)
  Eigen::Vector3d moment = Eigen::Vector3d::Zero();  // N m, on the hub, about its center
  RollingForces ground;                              // forces of the ground on the tire
  std::vector<RollingPatchPoint> patch;              // points in contact
  double spin = 0.0, spin_rate = 0.0;                // rad/s, rad/s^2
  double height = 0.0;                               // m, of the wheel center over the ground
  int iterations = 0, factors = 0, passes = 0;       // work of the step
};

/// Returns the forces on the hub from those of the ground and from the sums of the tire's inertia,
/// N and N m about the wheel center, in the wheel's axes.
TransientForces on_hub(const RollingCase& of,
                       const RollingForces& ground,
                       const Eigen::Vector3d& inertia,
                       const Eigen::Vector3d& moment_of_inertia);
/// Fails if the ground touches the tread farther than `reach`, m, from the axle. `touching`: half
/// angle of the tread that may touch, rad.
Status check_reach(const std::vector<RollingPatchPoint>& patch, double reach, double touching);
/// Ratio of the spin at the start to the least permitted spin. The past of the tread is kept for as
/// long as a wheel at this least spin needs it.
inline constexpr double kSlowest = 4.0;
/// Fails if the wheel spins too slowly, rad/s.
Status check_spin(double spin, double first_spin);
/// Returns the case of a step to this wheel: no drive, and a load if the ground follows one.
RollingCase case_of(const WheelMoment& to);

}  // namespace latsch::fe_tire
