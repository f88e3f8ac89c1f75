// SPDX-License-Identifier: Apache-2.0
// Version of tread_friction.h for eight blocks at a time.
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

/// Solution of (14) on a straight piece of μ; `holds` is true if it is on the piece.
struct OnPiece {
  Lanes v;
  Lanes::Mask holds;
};

LATSCH_INLINE OnPiece on_piece(const FrictionLaw::Table& law,
                               int i,
                               const Lanes& T,
                               const Lanes& slope,
                               const Lanes& F,
                               const Lanes& mu,
                               const Lanes& next) {
  const Lanes steeper = slope + F * ((next - mu) * law.over_range[i]);
  const Lanes v = law.speed[i] + ((T - slope * law.speed[i]) - mu * F) / steeper;
  return {v, (steeper > 0.0) & (v <= law.speed[i + 1])};
}

/// Returns v >= 0 of (14). `factor` of the road multiplies μ; `slope` is c (h + t_d) with c of the
/// touching part.
LATSCH_INLINE Lanes sliding_speed(const FrictionLaw::Table& law,
                                  const Lanes& T,
                                  const Lanes& slope,
                                  const Lanes& Fn,
                                  const Lanes& p,
                                  const Lanes& factor) {
  const Lanes inside = clamped(law, p), F = factor * Fn;
  Lanes mu[4];
  for (int i = 0; i < 2; ++i) mu[i] = coefficient(law.at[i], inside);
  const OnPiece slowest = on_piece(law, 0, T, slope, F, mu[0], mu[1]);
  const auto sticks = T <= mu[0] * F;
  Lanes v = slowest.v;
  if (!every(slowest.holds | sticks)) {
    for (int i = 2; i < 4; ++i) mu[i] = coefficient(law.at[i], inside);
    v = (T - mu[3] * F) / slope;
    for (int i = 2; i > 0; --i) {  // the slowest solution overrides the others
      const OnPiece own = on_piece(law, i, T, slope, F, mu[i], mu[i + 1]);
      v = select(own.holds, own.v, v);
    }
    v = select(slowest.holds, slowest.v, v);
  }
  return select(sticks, 0.0, v);
}

}  // namespace latsch::ring_tire::LATSCH_KERNELS
#endif
