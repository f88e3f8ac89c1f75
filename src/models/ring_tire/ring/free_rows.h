// SPDX-License-Identifier: Apache-2.0
// A free wheel (models/tire/free_wheel.h) as one or two more unknowns of a ring's step: y, the
// spin's angle or the axle's height, beside the belt's x. φ: the motion of nodes that go with the
// rim. With r what is left of (17), ρ what is left of the wheel's own rule,
//   K dx - (1-θ) g dy = r,   -g' dx + (g' φ + D) dy = ρ                                        (36)
//   g = df/dy = dT/dx,      D: the wheel's inertia by its rule
// Moving the rim is moving the nodes the other way, and forces have an energy: one g is both, that
// of the sidewall alone. With p = K^-1 r, Newton's step at a held rim,
//   dy = (ρ + g' p)/(D + g' φ - (1-θ) g' K^-1 g),   dx = p + (1-θ) K^-1 g dy
// where for K^-1 g stands φ s, s = g' φ/(φ' (M/(β h²)) φ + (1-θ) g' φ): what a ring without a
// road does. dy is small beside p, so that takes no more iterations than the K^-1 g of one more
// solution, 2 µs of a step of 50. Where K is held from an earlier step, so are g and s. Left out:
// the turning of dampers with the wheel, as in K, and how the blocks' moment on the rim changes.
#pragma once

#include "models/ring_tire/belt/inner_forces.h"
#include "models/tire/free_wheel.h"

namespace latsch::ring_tire {

/// Keeps its memory from one step to the next.
class FreeRows {
 public:
  /// `share`: 1 - θ.
  FreeRows(const RingParameters& parameters, double share);

  /// The wheel before a step.
  void start(const FreeWheel& wheel) { wheel_ = wheel; }
  /// At the end of the last step that was accepted.
  const FreeWheel& wheel() const { return wheel_; }
  /// With what is free as the solution of a step has it.
  const WheelMotion& motion() const { return motion_; }

  /// A step to a motion: where it begins to be solved.
  const WheelMotion& begin(const WheelMotion& motion, double time, double step);
  /// With `inner`, forces of belt and sidewall, on the nodes at q, and the blocks' moment on the
  /// rim: what the wheel's rule leaves, as a force, N.
  double find_left(const NodeValues& q, const NodeValues& inner, const Eigen::Vector3d& on_rim);
  /// g and s at q, where `forces` were asked last; `acceleration`: 1/(β h²), `which`: a number of
  /// the tangent.
  void take_tangent(InnerForces& forces,
                    const RimFrame& rim,
                    const NodeValues& q,
                    double acceleration,
                    long which);
  /// Whether g is of that tangent.
  bool knows_tangent(long which) const;
  /// p becomes dx, and the motion follows. False where the wheel's rule has no solution.
  bool correct(const RimFrame& rim, const NodeValues& q, NodeValues& p);
  /// The step is done.
  void accept(const NodeValues& q, const NodeValues& inner, const Eigen::Vector3d& on_rim);

 private:
  enum Way { kSpin, kHeight, kWays };

  bool is_free(int way) const { return way == kSpin ? !!wheel_.spin : !!wheel_.height; }
  /// φ of a node at x.
  Eigen::Vector3d with_rim(int way, const Eigen::Vector3d& x) const {
    return way == kSpin ? Eigen::Vector3d(motion_.carrier.col(1).cross(x - motion_.center))
                        : Eigen::Vector3d(Eigen::Vector3d::UnitZ());
  }
  /// T.
  FreeWheel::Pair forces(const NodeValues& q,
                         const NodeValues& inner,
                         const Eigen::Vector3d& on_rim) const;

  double share_, radius_, inertia_[kWays];  // of the belt: kg m^2, kg
  FreeWheel wheel_;
  WheelMotion motion_;
  double time_ = 0.0, step_ = 0.0;
  FreeWheel::Pair rates_ = FreeWheel::Pair::Zero(), forces_ = rates_;  // of the solution
  std::vector<RimRows> rows_;                                          // g, in the rim's axes
  double follows_[kWays] = {0.0, 0.0};                                 // s
  long tangent_[kWays] = {0, 0};
  FreeWheel::Matrix stiffness_ = FreeWheel::Matrix::Zero();  // g' φ - (1-θ) g' K^-1 g
};

}  // namespace latsch::ring_tire
