// SPDX-License-Identifier: Apache-2.0
// The longitudinal force, pure (4.E9)-(4.E18) and combined (4.E50)-(4.E57) [Pacejka 2012].
#if defined(LATSCH_MAGIC_FORMULA_LONGITUDINAL) == defined(LATSCH_KERNEL_TOGGLE)
#ifdef LATSCH_MAGIC_FORMULA_LONGITUDINAL
#undef LATSCH_MAGIC_FORMULA_LONGITUDINAL
#else
#define LATSCH_MAGIC_FORMULA_LONGITUDINAL
#endif

#include "models/magic_formula/operating_point.h"

namespace latsch::magic_formula::LATSCH_KERNELS {

template <class R>
struct Longitudinal {
  R Fx, mux, Kxk;
  R Dx, SVx;
};

/// Computes the terms of the longitudinal force except Fx itself. The arguments of its three curves
/// are written to `shapes`.
template <class R>
LATSCH_INLINE Longitudinal<R> longitudinal_terms(const TireOf<R>& tire,
                                                 const Conventions& conventions,
                                                 const OperatingPoint<R>& o,
                                                 Shapes<R>& shapes) {
  const auto& p = tire.p;
  const R &dfz = o.dfz, &dpi = o.dpi;
  const R gamma = o.gamma * (tire.mf52 ? p.LGAX : 1.0);
  Longitudinal<R> x;
  R zeta1 = R(1.0);
  if (conventions.turn_slip) {
    const R Bxp = p.PDXP1 * (1.0 + p.PDXP2 * dfz) * cos_atan(p.PDXP3 * o.kappa);  // (4.106)
    zeta1 = cos_atan(Bxp * p.UNLOADED_RADIUS * o.phi);                            // (4.105)
  }
  const R Cx = R(p.PCX1 * p.LCX);  // (4.E11)
  x.mux = (p.PDX1 + p.PDX2 * dfz) * (1.0 + p.PPX3 * dpi + p.PPX4 * dpi * dpi) *
          (1.0 - p.PDX3 * gamma * gamma) * o.LMUX_star;  // (4.E13)
  x.mux = select(o.Fz == 0.0, R(0.0), x.mux);
  x.Dx = x.mux * o.Fz * zeta1;  // (4.E12)
  x.Kxk = o.Fz * (p.PKX1 + p.PKX2 * dfz) * o.exp_PKX3 * (1.0 + p.PPX1 * dpi + p.PPX2 * dpi * dpi) *
          p.LKX;                                                                   // (4.E15)
  const R Bx = x.Kxk / (Cx * x.Dx + epsilon_for(x.Dx));                            // (4.E16)
  const R SHx = (p.PHX1 + p.PHX2 * dfz) * p.LHX * o.fade;                          // (4.E17)
  x.SVx = o.Fz * (p.PVX1 + p.PVX2 * dfz) * p.LVX * o.LMUX_prime * zeta1 * o.fade;  // (4.E18)
  const R kappax = o.kappa + SHx;                                                  // (4.E10)
  const R Ex = (p.PEX1 + p.PEX2 * dfz + p.PEX3 * dfz * dfz) * (1.0 - p.PEX4 * sign(kappax)) *
               p.LEX;  // (4.E14)
  shapes.set(Shapes<R>::kFx, Bx * kappax, Cx, Ex);

  const R Bxa = (p.RBX1 + p.RBX3 * o.gamma_star * o.gamma_star) * o.cos_RBX2 * p.LXAL;  // (4.E54)
  const R Cxa = R(p.RCX1);                                                              // (4.E55)
  const R Exa = p.REX1 + p.REX2 * dfz;                                                  // (4.E56)
  const ConstantOf<R> SHxa = p.RHX1;                                                    // (4.E57)
  shapes.set(Shapes<R>::kGx0, Bxa * SHxa, Cxa, Exa);
  shapes.set(Shapes<R>::kGx, Bxa * (o.alpha_star + SHxa), Cxa, Exa);  // (4.E53)
  return x;
}

template <class R>
LATSCH_INLINE void finish(const OperatingPoint<R>& o, const Shapes<R>& shapes, Longitudinal<R>& x) {
  const R Fx0 = x.Dx * shapes.sine[Shapes<R>::kFx] + x.SVx;                      // (4.E9)
  const R Gxa = shapes.cosine[Shapes<R>::kGx] / shapes.cosine[Shapes<R>::kGx0];  // (4.E51), (4.E52)
  x.Fx = Gxa * select(o.Vx < 0.0, -Fx0, Fx0);                                    // (4.E50)
}

}  // namespace latsch::magic_formula::LATSCH_KERNELS
#endif
