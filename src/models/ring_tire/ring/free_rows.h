// SPDX-License-Identifier: Apache-2.0
// A free wheel (models/tire/free_wheel.h) adds one or two unknowns y to the belt's unknowns x in a
// ring's step: the spin angle or the axle's height. φ is the motion of nodes that move with the
// rim, r the residual of (17), and ρ the residual of the wheel's own rule:
//   K dx - (1-θ) g dy = r,   -g' dx + (g' φ + D) dy = ρ                                        (36)
//   g = df/dy = dT/dx,      D: the wheel's inertia by its rule
// Moving the rim is equivalent to moving the nodes in the opposite direction, and the forces have
// an energy, so both derivatives are the same g, that of the sidewall alone. With p = K^-1 r,
// Newton's step at a held rim,
//   dy = (ρ + g' p)/(D + g' φ - (1-θ) g' K^-1 g),   dx = p + (1-θ) K^-1 g dy
// K^-1 g is approximated by φ s, s = g' φ/(φ' (M/(β h²)) φ + (1-θ) g' φ), which is exact for a ring
// without a road. dy is small compared with p, so this needs no more iterations than the exact K^-1
// g, which would cost one more solution, 2 µs of a step of 50. If K is held from an earlier step, g
// and s are held too. As in K, the rotation of dampers with the wheel is left out, and so is the
// change of the blocks' moment on the rim.
#pragma once

#include "models/ring_tire/belt/inner_forces.h"
#include "models/tire/free_wheel.h"

namespace latsch::ring_tire {

/// The rows of a free wheel, which keep their memory from one step to the next.
class FreeRows {
 public:
  /// `share` is 1 - θ.
  FreeRows(const RingParameters& parameters, double share);

  /// Sets the wheel before a step.
  void start(const FreeWheel& wheel) { wheel_ = wheel; }
  /// Returns the wheel at the end of the last accepted step.
  const FreeWheel& wheel() const { return wheel_; }
  /// Returns the motion with the free coordinates from the solution of a step.
  const WheelMotion& motion() const { return motion_; }

  /// Starts a step to a motion and returns the initial guess.
  const WheelMotion& begin(const WheelMotion& motion, double time, double step);
  /// Returns the residual of the wheel's rule as a force, N. `inner` are the forces of belt and
  /// sidewall on the nodes at q, `on_rim` is the blocks' moment on the rim.
  double find_left(const NodeValues& q, const NodeValues& inner, const Eigen::Vector3d& on_rim);
  /// Computes g and s at q, where `forces` were last evaluated. `acceleration` is 1/(β h²), `which`
  /// identifies the tangent.
  void take_tangent(InnerForces& forces,
                    const RimFrame& rim,
                    const NodeValues& q,
                    double acceleration,
                    long which);
  /// True if g belongs to the tangent `which`.
  bool knows_tangent(long which) const;
  /// Changes p to dx and updates the motion. Returns false if the wheel's rule has no solution.
  bool correct(const RimFrame& rim, const NodeValues& q, NodeValues& p);
  /// Ends the step.
  void accept(const NodeValues& q, const NodeValues& inner, const Eigen::Vector3d& on_rim);

 private:
  enum Way { kSpin, kHeight, kWays };

  bool is_free(int way) const { return way == kSpin ? !!wheel_.spin : !!wheel_.height; }
  /// Returns φ of a node at x.
  Eigen::Vector3d with_rim(int way, const Eigen::Vector3d& x) const {
    return way == kSpin ? Eigen::Vector3d(motion_.carrier.col(1).cross(x - motion_.center))
                        : Eigen::Vector3d(Eigen::Vector3d::UnitZ());
  }
  /// Returns T.
  FreeWheel::Pair forces(const NodeValues& q,
                         const NodeValues& inner,
                         const Eigen::Vector3d& on_rim) const;

  double share_, radius_, inertia_[kWays];  // inertia of the belt: kg m^2, kg
  FreeWheel wheel_;
  WheelMotion motion_;
  double time_ = 0.0, step_ = 0.0;
  FreeWheel::Pair rates_ = FreeWheel::Pair::Zero(), forces_ = rates_;  // values at the solution
  std::vector<RimRows> rows_;                                          // g, in the rim's axes
  double follows_[kWays] = {0.0, 0.0};                                 // s
  long tangent_[kWays] = {0, 0};
  FreeWheel::Matrix stiffness_ = FreeWheel::Matrix::Zero();  // g' φ - (1-θ) g' K^-1 g
};

}  // namespace latsch::ring_tire
