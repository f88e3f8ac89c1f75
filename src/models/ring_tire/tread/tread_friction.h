// SPDX-License-Identifier: Apache-2.0
// Friction coefficient of tread rubber μ(v, p). It is quadratic in the pressure p through its three
// values and constant beyond the first and the last; it is linear in the sliding speed v between
// adhesion, maximum, sliding and blocking, and constant beyond.
//
// The tip of a massless block slides so that spring, damper and friction balance at the step's end:
//   T - c (h + t_d) v = μ(v, p) F_n                                                          (14)
// T is the force the block would have if its tip stuck. On each straight piece of μ this is a
// linear equation; the slowest solution is used, because a sticking tip reaches it first.
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
  /// Data of the blocks' loop, which processes eight blocks at a time (friction_lanes.h).
  struct Table {
    double lowest, highest;  // Pa
    Quadratic at[4];         // at the four speeds
    double speed[4];         // m/s
    double over_range[3];    // 1 over the difference of neighboring speeds
  };
  const Table& table() const { return table_; }

 private:
  Table table_;
};

}  // namespace latsch::ring_tire
