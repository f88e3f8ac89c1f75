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
#include "numerics/lane_math.h"

namespace latsch::ring_tire {

class FrictionLaw {
 public:
  explicit FrictionLaw(const TreadFriction& friction);

  // R: double, or eight of them side by side (lane_math.h).
  template <class R>
  LATSCH_INLINE R adhesion(const R& p) const {
    return coefficient(at_[0], clamped(p));
  }
  double mu(double v, double p) const;
  /// v >= 0 of (14); `factor` of the road multiplies μ, `slope` is c (h + t_d).
  template <class R>
  LATSCH_INLINE R
  sliding_speed(const R& T, double slope, const R& Fn, const R& p, const R& factor) const;

 private:
  /// c0 + c1 p + c2 p^2 from p = lowest to highest, constant beyond.
  struct Quadratic {
    double c0, c1, c2;
  };
  template <class R>
  LATSCH_INLINE static R coefficient(const Quadratic& q, const R& p) {
    return q.c0 + p * (q.c1 + p * q.c2);
  }
  template <class R>
  LATSCH_INLINE R clamped(const R& p) const {
    using lane_math::constant;
    return lane_math::larger(constant<R>(lowest_), lane_math::smaller(constant<R>(highest_), p));
  }

  double lowest_, highest_;
  Quadratic at_[4];  // at the four speeds
  double speed_[4];
};

template <class R>
R FrictionLaw::sliding_speed(
    const R& T, double slope, const R& Fn, const R& p, const R& factor) const {
  using lane_math::constant, lane_math::select;
  const R inside = clamped(p), F = factor * Fn;
  R mu[4];
  for (int i = 0; i < 4; ++i) mu[i] = coefficient(at_[i], inside);
  R v = (T - mu[3] * F) / slope;
  for (int i = 2; i >= 0; --i) {  // the slowest solution has the last word
    const R rise = F * (mu[i + 1] - mu[i]) / (speed_[i + 1] - speed_[i]);
    const R excess = T - slope * speed_[i] - mu[i] * F;  // > 0 at the piece's beginning
    const R at = speed_[i] + excess / (slope + rise);
    v = select(slope + rise > 0.0, select(at <= speed_[i + 1], at, v), v);
  }
  return select(T <= mu[0] * F, constant<R>(0.0), v);
}

}  // namespace latsch::ring_tire
