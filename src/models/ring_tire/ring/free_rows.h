// SPDX-License-Identifier: Apache-2.0
// A free wheel (models/tire/free_wheel.h) adds one or two unknowns y to the belt's unknowns x in a
// ring's step: the spin angle or the axle's height. φ is the motion of the nodes if they move with
// the rim, r the residual of (17), and ρ the residual of the wheel's equation of motion (its
// trapezoidal rule):
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

/// The additional unknowns and equations of a free wheel. Their memory is reused from one step to
/// the next.
class FreeRows {
 public:
  /// `share` is 1 - θ in the time integration (17).
  FreeRows(const RingParameters& parameters, double share);

  /// Sets the state of the wheel before a step.
  void start(const FreeWheel& wheel) { wheel_ = wheel; }
  /// Returns the wheel at the end of the last accepted step.
  const FreeWheel& wheel() const { return wheel_; }
  /// Returns the motion of the wheel; its free coordinates are those found by the solution of the
  /// step.
  const WheelMotion& motion() const { return motion_; }

  /// Begins a step to `motion` and returns the initial guess of the wheel's motion.
  const WheelMotion& begin(const WheelMotion& motion, double time, double step);
  /// Returns the residual of the wheel's equation of motion as a force, N. `inner` holds the forces
  /// of belt and sidewall on the nodes at the positions q; `on_rim` is the moment of the tread
  /// blocks on the rim.
  double find_left(const NodeValues& q, const NodeValues& inner, const Eigen::Vector3d& on_rim);
  /// Computes g and s at the positions q, where `forces` was last evaluated. `acceleration` is 1/(β
  /// h²), and `which` is the number of the tangent.
  void take_tangent(InnerForces& forces,
                    const RimFrame& rim,
                    const NodeValues& q,
                    double acceleration,
                    long which);
  /// Returns true if g was computed for the tangent with the number `which`.
  bool knows_tangent(long which) const;
  /// Changes Newton's step p of the belt at a fixed rim to the step dx with the free wheel, and
  /// updates the motion. Returns false if the wheel's equation has no solution.
  bool correct(const RimFrame& rim, const NodeValues& q, NodeValues& p);
  /// Accepts the step and stores the state of the wheel at its end.
  void accept(const NodeValues& q, const NodeValues& inner, const Eigen::Vector3d& on_rim);

 private:
  enum Way { kSpin, kHeight, kWays };

  bool is_free(int way) const { return way == kSpin ? !!wheel_.spin : !!wheel_.height; }
  /// Returns φ, the motion with the rim per unit of the free coordinate, of a node at the position
  /// x.
  Eigen::Vector3d with_rim(int way, const Eigen::Vector3d& x) const {
    return way == kSpin ? Eigen::Vector3d(motion_.carrier.col(1).cross(x - motion_.center))
                        : Eigen::Vector3d(Eigen::Vector3d::UnitZ());
  }
  /// Returns T.
  FreeWheel::Pair forces(const NodeValues& q,
                         const NodeValues& inner,
                         const Eigen::Vector3d& on_rim) const;

  // Inertia of the belt: kg m^2 for the spin, kg for the height.
  double share_, radius_, inertia_[kWays];
  FreeWheel wheel_;
  WheelMotion motion_;
  double time_ = 0.0, step_ = 0.0;
  // Rates and forces at the solution of the step.
  FreeWheel::Pair rates_ = FreeWheel::Pair::Zero(), forces_ = rates_;
  std::vector<RimRows> rows_;           // vector g of (36), in the axes of the rim
  double follows_[kWays] = {0.0, 0.0};  // s
  long tangent_[kWays] = {0, 0};
  FreeWheel::Matrix stiffness_ = FreeWheel::Matrix::Zero();  // g' φ - (1-θ) g' K^-1 g
};

}  // namespace latsch::ring_tire
