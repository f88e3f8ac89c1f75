// SPDX-License-Identifier: Apache-2.0
// The sidewall between belt and rim. The knots of the belt (belt_curve.h) are called nodes here.
// The travel of node k along the rim's e_r, e_t and a is
//   u_r = e_r . (x_k - c) - R,  u_t = e_t . (x_k - c),  u_y = a . (x_k - c)
// Along each direction, times the node's share of the circumference 2π R/N, the force is
//   F = k u + d u' + k_M (u - u_i) + sum of friction elements,  τ u_i' = u - u_i             (6)
// The slope of the radial spring grows with travel toward the rim or away from it, up to a bound:
//   F_r = k (u + P (u - u_p atan(u/u_p))),  slope k (1 + P u^2/(u^2 + u_p^2))                (7)
// Beyond the inward travel b the belt lies on the rim:
//   F_r = k_b (u + b) in addition, if u < -b                                                (28)
// Friction element i of n: a spring S k/n that slips at F_i = F 2i/(n(n+1)); n = 5 radially.  (8)
// The section's torsion relative to the rim is coupled to lateral travel:
//   energy 1/2 c_ψ (ψ - ψ_0 - λ u_y)^2, damping d_ψ; ψ_0: of (33)                           (9)
// Maxwell elements use the trapezoidal rule, friction elements a return to the slip force.
#pragma once

#include "models/ring_tire/belt/rim_frame.h"
#include "models/ring_tire/belt/rim_rows.h"
#include "models/ring_tire/belt/stiffness_rows.h"
#include "models/ring_tire/description/ring_parameters.h"

namespace latsch::ring_tire {

/// Derivatives of the state at the end of a step with respect to its unknowns.
struct StepRule {
  double step = 0.0;          // s; 0: statics, where dampers and Maxwell elements are at rest
  double velocity = 0.0;      // dv/dq, 1/s
  double acceleration = 0.0;  // da/dq, 1/s^2

  bool statics() const { return step == 0.0; }
};

class SidewallForces {
 public:
  /// `conicity` is ψ_0 of (33), rad.
  SidewallForces(const Sidewall& sidewall, double radius, int nodes, double conicity = 0.0);

  /// Values along e_r, e_t and a, one row for each, one column for each node.
  using Travels = Eigen::Matrix<double, 3, Eigen::Dynamic, Eigen::RowMajor>;
  static constexpr int kRadialFrictions = 5;
  static constexpr int kFrictions = kRadialFrictions + 2;
  /// State of the elements at the last commit.
  struct Memory {
    Travels travel;   // m
    Travels maxwell;  // u - u_i of (6), m
    /// Stretch of (8), m; empty without friction.
    Eigen::Matrix<double, kFrictions, Eigen::Dynamic, Eigen::RowMajor> slip;

    bool operator==(const Memory&) const = default;
  };

  /// Relaxes all elements, with the belt at its position at rest.
  void reset();
  const Memory& memory() const { return memory_; }
  void remember(const Memory& memory) { memory_ = memory; }
  /// Computes the forces at the end of a step from the last committed state, with knots at the
  /// positions `at` and their rates; `force` has kScratch additional rows.
  void find_force(const RimRows& at,
                  const RimRows& rate,
                  const StepRule& rule,
                  RimRows& force) const;
  static constexpr int kScratch = 9;
  void add_stiffness(const RimRows& at, const StepRule& rule, double scale, StiffnessRows& K) const;
  /// First row of K's scratch with the derivatives at the knots, times scale: xx, xz, zz of the
  /// rim's axes and, without torsion, yy.
  static constexpr int kKnotSlopes = 6;
  double torsion() const { return torsion_; }                        // N per rad of a node
  double torsion_by_lateral() const { return torsion_by_lateral_; }  // rad/m
  /// Damping of a node along e_r, e_t, a and of its torsion, and the stiffness of its Maxwell
  /// elements.
  struct Losses {
    Eigen::Vector4d damping, maxwell;
    double time_constant;
  };
  Losses losses() const;
  /// Sets the force of the friction springs to zero, so that small vibrations about the present
  /// state do not make them slip.
  void stick() { memory_.slip.setZero(); }
  /// Ends the step: the next one starts from its end.
  void commit(const RimRows& at, const StepRule& rule);

  /// Energy of all springs, J, after commit.
  double energy(const NodeValues& q, const RimFrame& rim) const;

 private:
  struct Direction {
    double k, d, k_maxwell;
  };
  struct Friction {
    int direction;
    double k, limit;
  };
  void to_polar(const RimRows& at, double R, double* const polar[3]) const;
  Eigen::Vector3d travel(const NodeValues& q, const RimFrame& rim, int k) const;
  /// Computes the derivatives of the force along one direction, of all its elements.
  void find_slopes(int direction, const double* u, const StepRule& rule, double* slope) const;
  void add_spring(int direction, const double* u, double* F) const;
  void add_memory(int direction, const double* u, const StepRule& rule, double* F) const;
  double half_step(const StepRule& rule) const { return rule.step / (2.0 * tau_); }
  double most_stretch(const Friction& f) const { return f.k > 0.0 ? f.limit / f.k : 0.0; }

  NodeAngles angles_;
  double R_, tau_, progressivity_, progressive_travel_;
  double rim_travel_, rim_stiffness_;  // m; N/m of a node, 0: no rim
  double torsion_, torsion_damping_, torsion_by_lateral_, conicity_;
  Direction direction_[3];
  Friction friction_[kFrictions];
  bool has_memory_;
  Memory memory_;
  Travels now_;  // at the end of the current step
};

}  // namespace latsch::ring_tire
