// SPDX-License-Identifier: Apache-2.0
// tread_friction.h for eight blocks at a time.
#if defined(LATSCH_RING_FRICTION_LANES) == defined(LATSCH_KERNEL_TOGGLE)
#ifdef LATSCH_RING_FRICTION_LANES
#undef LATSCH_RING_FRICTION_LANES
#else
#define LATSCH_RING_FRICTION_LANES
#endif

#include "models/ring_tire/tread/tread_friction.h"
#include "numerics/kernels/kernel_lanes.h"

namespace latsch::ring_tire::LATSCH_KERNELS {

using namespace latsch::LATSCH_KERNELS;

LATSCH_INLINE Lanes coefficient(const FrictionLaw::Quadratic& q, const Lanes& p) {
  return q.c0 + p * (q.c1 + p * q.c2);
}
LATSCH_INLINE Lanes clamped(const FrictionLaw::Table& law, const Lanes& p) {
  return larger(law.lowest, smaller(law.highest, p));
}
LATSCH_INLINE Lanes adhesion(const FrictionLaw::Table& law, const Lanes& p) {
  return coefficient(law.at[0], clamped(law, p));
}

/// v >= 0 of (14); `factor` of the road multiplies μ, `slope` is c (h + t_d), c of what touches.
LATSCH_INLINE Lanes sliding_speed(const FrictionLaw::Table& law,
                                  const Lanes& T,
                                  const Lanes& slope,
                                  const Lanes& Fn,
                                  const Lanes& p,
                                  const Lanes& factor) {
  const Lanes inside = clamped(law, p), F = factor * Fn;
  Lanes mu[4];
  for (int i = 0; i < 4; ++i) mu[i] = coefficient(law.at[i], inside);
  Lanes v = (T - mu[3] * F) / slope;
  for (int i = 2; i >= 0; --i) {  // the slowest solution has the last word
    const double from = law.speed[i], to = law.speed[i + 1];
    const Lanes rise = F * ((mu[i + 1] - mu[i]) * (1.0 / (to - from)));
    const Lanes excess = (T - slope * from) - mu[i] * F;  // > 0 at the piece's beginning
    const Lanes at = from + excess / (slope + rise);
    v = select((slope + rise > 0.0) & (at <= to), at, v);
  }
  return select(T <= mu[0] * F, 0.0, v);
}

}  // namespace latsch::ring_tire::LATSCH_KERNELS
#endif
