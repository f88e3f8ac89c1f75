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

#include "models/ring_tire/ring_parameters.h"

namespace latsch::ring_tire {

class FrictionLaw {
 public:
  explicit FrictionLaw(const TreadFriction& friction);

  struct AtPressure {
    double mu[4];  // at the four speeds
  };
  AtPressure at_pressure(double p) const;
  double adhesion(double p) const { return coefficient(adhesion_, clamped(p)); }

  /// μ of adhesion is c0 + c1 p + c2 p^2 from p = lowest to highest, constant beyond.
  struct Quadratic {
    double c0, c1, c2;
  };
  const Quadratic& adhesion_law() const { return adhesion_; }
  double lowest_pressure() const { return lowest_; }
  double highest_pressure() const { return highest_; }

  double mu(double v, double p) const;
  /// v >= 0 of (14); `factor` of the road multiplies μ, `slope` is c (h + t_d).
  double sliding_speed(double T, double slope, double Fn, double p, double factor) const;

 private:
  static double coefficient(const Quadratic& q, double p) { return q.c0 + p * (q.c1 + p * q.c2); }
  double clamped(double p) const { return p < lowest_ ? lowest_ : p > highest_ ? highest_ : p; }

  double lowest_, highest_;
  Quadratic adhesion_;
  Quadratic at_[4];
  double speed_[4];
};

}  // namespace latsch::ring_tire
