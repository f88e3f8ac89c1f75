// SPDX-License-Identifier: Apache-2.0
// Overturning moment (4.E69) with the terms QSX12-QSX14 of MF-Tyre 6.1, and rolling resistance
// moment (A48) of [Besselink et al. 2010]. The rolling resistance of MF 5.2 is proportional to Fz,
// with the terms QSY5 to QSY8 if a file has them, as in PAC2002. Below FZMIN both moments fade with
// the load; the rolling resistance also fades with the sliding of a locked wheel.
#if defined(LATSCH_MAGIC_FORMULA_MOMENTS) == defined(LATSCH_KERNEL_TOGGLE)
#ifdef LATSCH_MAGIC_FORMULA_MOMENTS
#undef LATSCH_MAGIC_FORMULA_MOMENTS
#else
#define LATSCH_MAGIC_FORMULA_MOMENTS
#endif

#include "models/magic_formula/operating_point.h"

namespace latsch::magic_formula::LATSCH_KERNELS {

/// The three terms of (4.E69) with an arc tangent: cos(QSX5 atan x[0]), sin(angle + QSX8 atan
/// x[1]), atan x[2].
template <class R>
struct OverturningShapes {
  R cosine, sine, arc;
};
LATSCH_INLINE OverturningShapes<Lane> overturning_shapes(const CoefficientsFor<Lane>& p,
                                                         const Lane (&x)[3],
                                                         const Lane& angle) {
  const Lanes4 arcs = atan(gathered<3>(x));
  // The first addend is -0.0, because adding +0.0 would turn -0.0 into +0.0.
  const SinCos<Lanes4> r =
      sin_cos(four(p.QSX5, p.QSX8, 0.0, 0.0) * arcs + four(-0.0, angle.v, 0.0, 0.0));
  return {r.cos.at(0), r.sin.at(1), arcs.at(2)};
}
template <class R>
LATSCH_INLINE OverturningShapes<R> overturning_shapes(const CoefficientsFor<R>& p,
                                                      const R (&x)[3],
                                                      const R& angle) {
  return {cos(p.QSX5 * atan(x[0])), sin(p.QSX8 * atan(x[1]) + angle), atan(x[2])};
}

template <class R>
LATSCH_INLINE R overturning(const TireOf<R>& tire, const OperatingPoint<R>& o, const R& Fy) {
  const auto& p = tire.p;
  const R& gamma = o.gamma;
  const R Fz = faded_load(tire, o.Fz, true);
  const R fz = Fz * tire.per_FNOMIN, fy = Fy * tire.per_FNOMIN;
  R factor = p.QSX1 * p.LVMX - p.QSX2 * gamma * (1.0 + p.PPMX1 * o.dpi) + p.QSX3 * fy;
  if (matters(p.QSX4) || matters(p.QSX10)) {
    const R x[3] = {p.QSX6 * fz * (p.QSX6 * fz), p.QSX9 * fy, p.QSX11 * fz};
    const OverturningShapes<R> shapes = overturning_shapes(p, x, R(p.QSX7 * gamma));
    factor = factor + p.QSX4 * shapes.cosine * shapes.sine + p.QSX10 * shapes.arc * gamma;
  }
  const R sheared = Fy * (p.QSX13 + p.QSX14 * abs(gamma)) - Fz * p.QSX12 * gamma * abs(gamma);
  return p.UNLOADED_RADIUS * p.LMX * (Fz * factor + sheared);  // (4.E69)
}

template <class R>
LATSCH_INLINE R rolling_resistance(const TireOf<R>& tire, const OperatingPoint<R>& o, const R& Fx) {
  const auto& p = tire.p;
  const R& Fz = o.Fz_My;
  const R v = abs(o.Vx * tire.per_LONGVL);
  R factor = p.QSY1 + p.QSY2 * Fx * tire.per_FNOMIN + p.QSY3 * v + p.QSY4 * (v * v) * (v * v);
  R My;
  const bool camber = !tire.mf52 || matters(p.QSY5) || matters(p.QSY6);
  if (camber) factor = factor + (p.QSY5 + p.QSY6 * (Fz * tire.per_FNOMIN)) * o.gamma * o.gamma;
  if (tire.mf52) {
    My = -p.UNLOADED_RADIUS * Fz * p.LMY * factor;
    if (matters(p.QSY7) || matters(p.QSY8)) My = My * (o.load_power * o.pressure_power);
  } else {
    My = -p.UNLOADED_RADIUS * p.FNOMIN * p.LMY * factor *
         (o.load_power * o.pressure_power);  // (A48)
  }
  My = My * o.sign_Vx;
  // The rolling resistance moment fades if the wheel slides between the limits `low` and `high` of
  // kappa, and it is reversed if the wheel spins backward. Both limits have the same distance from
  // a locked wheel (kappa = -1).
  const R high = p.VXLOW / select(o.Vx == 0.0, R(kEpsilon), abs(o.Vx)) - 1.0;
  const R low = -2.0 - high;
  const R& kappa = o.kappa_given;
  const auto fading = ((kappa >= low) & (kappa <= high));
  if (any(fading)) {
    // The angle is 0 if VXLOW is 0.
    const R angle = 0.5 * kPi * (kappa + 1.0) / not_zero<R>(high + 1.0);
    My = select(fading, My * sin(angle), My);
  }
  return select(kappa < low, -My, My);
}

}  // namespace latsch::magic_formula::LATSCH_KERNELS
#endif
