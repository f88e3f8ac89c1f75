// SPDX-License-Identifier: Apache-2.0
// Deflection and loaded radius, contact patch, structural stiffnesses and relaxation lengths.
//
// (1)-(10), (17)-(19): [Besselink et al. 2010]. In MF 6.2 the deflection depends on camber, and the
// effect of the side force grows with it. MF 5.2 has separate relaxation lengths (PTX, PTY) and a
// separate patch length (Q_A1, Q_A2). Two sign rules keep denominators above zero. If the tire
// carries the load at no deflection, the loaded radius is returned as 0.
#if defined(LATSCH_MAGIC_FORMULA_GEOMETRY) == defined(LATSCH_KERNEL_TOGGLE)
#ifdef LATSCH_MAGIC_FORMULA_GEOMETRY
#undef LATSCH_MAGIC_FORMULA_GEOMETRY
#else
#define LATSCH_MAGIC_FORMULA_GEOMETRY
#endif

#include "models/magic_formula/operating_point.h"

namespace latsch::magic_formula::LATSCH_KERNELS {

template <class R>
struct Deflection {
  R rho, R_l;
};

/// Returns the factor 1 + q_V2 |omega| R0/V0 - (q_FCx Fx/Fz0)^2 - (q_FCy Fy/Fz0)^2 of the vertical
/// force in (3).
template <class R>
LATSCH_INLINE R stiffening(const TireOf<R>& tire, const R& omega, const R& x, const R& y) {
  return 1.0 + tire.p.Q_V2 * tire.R0_per_V0 * abs(omega) - x * x - y * y;
}

/// Returns the deflection at which the tire carries its load, equation (3) solved for rho, for MF
/// 5.2 and 6.1.
template <class R>
LATSCH_INLINE Deflection<R> deflection(const TireOf<R>& tire,
                                       const OperatingPoint<R>& o,
                                       const R& Fx,
                                       const R& Fy) {
  const auto& p = tire.p;
  const R external =
      stiffening<R>(tire, o.omega, p.Q_FCX * Fx * tire.per_FNOMIN, p.Q_FCY * Fy * tire.per_FNOMIN) *
      (1.0 + p.PFZ1 * o.dpi) * p.FNOMIN;
  const R load = larger(o.Fz, R(p.FZMIN));
  const R share = load / external;
  const R root = tire.Q_FZ1 * tire.Q_FZ1 + 4.0 * p.Q_FZ2 * share;
  const R x = 2.0 * share / (tire.Q_FZ1 + sqrt(larger(root, R(0.0))));
  Deflection<R> d;
  d.rho = larger(x * p.UNLOADED_RADIUS, R(0.0));
  d.R_l = larger(o.R_omega - d.rho, R(0.0));
  return d;
}

template <class R>
struct Patch {
  R a, b;  // half length and half width of the patch
};

template <class R>
LATSCH_INLINE Patch<R> contact_patch(const TireOf<R>& tire, const OperatingPoint<R>& o) {
  const auto& p = tire.p;
  const ConstantOf<R> R0 = p.UNLOADED_RADIUS;
  Patch<R> patch;
  if (tire.mf52) {
    const R Cz = p.VERTICAL_STIFFNESS * (1.0 + p.PFZ1 * o.dpi);  // (5)
    const R load = o.patch_load * (Cz * R0) * tire.per_FNOMIN;
    patch.a = R0 * (tire.Q_A2 * load + tire.Q_A1 * sqrt(load));
    patch.b = R(0.5 * p.WIDTH);
  } else {
    const R& load = o.patch_load;
    patch.a = R0 * (p.Q_RA2 * load + p.Q_RA1 * sqrt(load));         // (9)
    patch.b = p.WIDTH * (p.Q_RB2 * load + p.Q_RB1 * o.patch_root);  // (10)
  }
  return patch;
}

template <class R>
struct Relaxation {
  R Cx, Cy, sigma_x, sigma_y;
};

template <class R>
LATSCH_INLINE Relaxation<R> relaxation(const TireOf<R>& tire,
                                       const OperatingPoint<R>& o,
                                       const R& Kxk,
                                       const R& Kya) {
  const auto& p = tire.p;
  const R &dfz = o.dfz, &dpi = o.dpi;
  Relaxation<R> r;
  r.Cx = p.LONGITUDINAL_STIFFNESS * (1.0 + p.PCFX1 * dfz + p.PCFX2 * dfz * dfz) *
         (1.0 + p.PCFX3 * dpi);  // (17)
  r.Cy = p.LATERAL_STIFFNESS * (1.0 + p.PCFY1 * dfz + p.PCFY2 * dfz * dfz) *
         (1.0 + p.PCFY3 * dpi);  // (18)
  if (tire.mf52) {
    r.sigma_x = (p.PTX1 + p.PTX2 * dfz) * exp(-p.PTX3 * dfz) * p.LSGKP * p.UNLOADED_RADIUS * o.Fz *
                tire.per_FNOMIN;
    r.sigma_y = p.PTY2 == 0.0
                    ? R(0.0)
                    : p.PTY1 * sin(2.0 * atan(o.Fz / (p.PTY2 * tire.Fz0_prime))) *
                          (1.0 - p.PKY3 * abs(o.gamma)) * p.UNLOADED_RADIUS * p.LFZO * p.LSGAL;
  } else {
    r.sigma_x = p.LONGITUDINAL_STIFFNESS == 0.0 ? R(0.0) : abs(Kxk / r.Cx);  // (19)
    r.sigma_y = p.LATERAL_STIFFNESS == 0.0 ? R(0.0) : abs(Kya / r.Cy);
  }
  return r;
}

}  // namespace latsch::magic_formula::LATSCH_KERNELS
#endif
