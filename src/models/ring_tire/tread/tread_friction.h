// SPDX-License-Identifier: Apache-2.0
// Friction coefficient of tread rubber μ(v, p): quadratic in the pressure p through its three
// values, constant beyond the first and the last, and linear in the sliding speed v between
// adhesion, maximum, sliding and blocking; constant beyond.
//
// A mass-less block's tip slides so that spring, damper and friction balance at the step's end:
//   T - c (h + t_d) v = μ(v, p) F_n                                                          (14)
// T is the force the block would have if its tip stuck. On each straight piece of μ that is a
// linear equation; the slowest solution is the one a sticking tip comes to first.
#pragma once

#include "models/ring_tire/description/ring_parameters.h"

namespace latsch::ring_tire {

class FrictionLaw {
 public:
  explicit FrictionLaw(const TreadFriction& friction);

  double mu(double v, double p) const;

  /// c0 + c1 p + c2 p^2 from p = lowest to highest, constant beyond.
  struct Quadratic {
    double c0, c1, c2;
  };
  /// What the blocks' loop computes with, eight at a time (friction_lanes.h).
  struct Table {
    double lowest, highest;  // Pa
    Quadratic at[4];         // at the four speeds
    double speed[4];         // m/s
    double over_range[3];    // 1 over what lies between two of them
  };
  const Table& table() const { return table_; }

 private:
  Table table_;
};

}  // namespace latsch::ring_tire
