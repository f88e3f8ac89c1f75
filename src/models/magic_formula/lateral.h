// SPDX-License-Identifier: Apache-2.0
// The side force, pure (4.E19)-(4.E30) and combined (4.E58)-(4.E67) [Pacejka 2012], with the spin
// terms zeta_0, zeta_2, zeta_3, zeta_4 (4.77)-(4.90). The camber stiffness K_yg0 contains (1 +
// p_py5 dp), and MF 5.2 uses the shift from PHY3 instead of (4.E27).
#if defined(LATSCH_MAGIC_FORMULA_LATERAL) == defined(LATSCH_KERNEL_TOGGLE)
#ifdef LATSCH_MAGIC_FORMULA_LATERAL
#undef LATSCH_MAGIC_FORMULA_LATERAL
#else
#define LATSCH_MAGIC_FORMULA_LATERAL
#endif

#include "models/magic_formula/operating_point.h"

namespace latsch::magic_formula::LATSCH_KERNELS {

template <class R>
struct PureLateral {
  R Fy0, muy, Kya, per_Kya_prime, SHy, SVy, By, Cy, Dy, zeta2;
};

/// Returns the cornering stiffness K_ya (4.E25), with camber or without.
template <class R>
LATSCH_INLINE R cornering_stiffness(const TireOf<R>& tire,
                                    const OperatingPoint<R>& o,
                                    const R& gamma_star,
                                    const R& sine,
                                    const R& zeta3) {
  const auto& p = tire.p;
  return p.PKY1 * tire.Fz0_prime * (1.0 + p.PPY1 * o.dpi) * (1.0 - p.PKY3 * abs(gamma_star)) *
         sine * zeta3 * p.LKY;
}

/// Returns the camber stiffness K_yg0 (4.E30). For MF 5.2 it follows from the shifts.
template <class R>
LATSCH_INLINE R camber_stiffness(const TireOf<R>& tire, const OperatingPoint<R>& o) {
  const auto& p = tire.p;
  if (tire.mf52) {
    const R Kya0 =
        p.PKY1 * tire.Fz0_prime * p.LKYC * sin(p.PKY4 * atan(o.Fz / (p.PKY2 * tire.Fz0_prime)));
    return (p.PHY3 * Kya0 + o.Fz * (p.PVY3 + p.PVY4 * o.dfz)) * p.LKYC;
  }
  return o.Fz * (p.PKY6 + p.PKY7 * o.dfz) * (1.0 + p.PPY5 * o.dpi) * p.LKYC;
}

template <class R>
LATSCH_INLINE R with_epsilon(const R& stiffness) {
  return stiffness + epsilon_for(stiffness);  // (4.E39)
}

/// Returns zeta_2 (4.77), (4.78), the factor by which spin reduces the peak of the side force.
template <class R>
LATSCH_INLINE R peak_reduction_by_spin(const CoefficientsFor<R>& p, const OperatingPoint<R>& o) {
  const R Byp = p.PDYP1 * (1.0 + p.PDYP2 * o.dfz) * cos_atan(p.PDYP3 * o.tan_alpha);
  const R turns = p.UNLOADED_RADIUS * abs(o.phi);
  return cos_atan(Byp * (turns + p.PDYP4 * sqrt(turns)));
}

/// Returns S_Hyphi (4.80), (4.85)-(4.89), the horizontal shift of the side-force curve by spin.
template <class R>
LATSCH_INLINE R shift_by_spin(const TireOf<R>& tire,
                              const Conventions& conventions,
                              const OperatingPoint<R>& o,
                              const R& Kya0) {
  const auto& p = tire.p;
  const R CHyp = R(p.PHYP1);                                                       // (4.85)
  const R DHyp = (p.PHYP2 + p.PHYP3 * o.dfz) * o.sign_Vx;                          // (4.86)
  const R EHyp = R(conventions.limits && p.PHYP4 > 1.0 ? 1.0 : p.PHYP4);           // (4.87)
  const R KyRp0 = camber_stiffness(tire, o) / not_zero<R>(1.0 - o.epsilon_gamma);  // (4.89)
  // If the curve's amplitude is 0 (PHYP2 = 0), the shift is 0 for any steepness, so the steepness
  // may be limited. Far beyond its bend the curve is flat.
  constexpr double kSteep = 1e100;
  const R steepness = KyRp0 / not_zero<R>(CHyp * DHyp * with_epsilon(Kya0));  // (4.88)
  const R BHyp = larger(smaller(steepness, R(kSteep)), R(-kSteep));
  const R x = BHyp * p.UNLOADED_RADIUS * o.phi;
  const R SHyp = DHyp * sine_shape(x, CHyp, EHyp) * o.sign_Vx;  // (4.80)
  return select(o.sign_Vx == 0.0, R(0.0), SHyp);
}

template <class R>
LATSCH_INLINE R shift_by_camber(const TireOf<R>& tire,
                                const Conventions& conventions,
                                const OperatingPoint<R>& o,
                                const R& gamma_star,
                                const R& SVyg,
                                const R& per_Kya_prime,
                                const R& zeta3) {
  const auto& p = tire.p;
  if (tire.mf52) return p.PHY3 * gamma_star * p.LKYC;
  if (conventions.turn_slip) {  // with spin, zeta_0 = 0 (4.83), and the term is zeta_4 - 1 (4.84)
    const R Kya0 = cornering_stiffness<R>(tire, o, R(0.0), o.sin_K0, zeta3);
    return shift_by_spin(tire, conventions, o, Kya0) - SVyg * per_Kya_prime;
  }
  return (camber_stiffness(tire, o) * gamma_star - SVyg) * per_Kya_prime;
}

/// Computes the terms of the pure side force except Fy0 itself, for the cambered or the upright
/// wheel. The arguments of its curve are written to `shapes`.
template <class R>
LATSCH_INLINE PureLateral<R> pure_lateral_terms(const TireOf<R>& tire,
                                                const Conventions& conventions,
                                                const OperatingPoint<R>& o,
                                                bool upright,
                                                Shapes<R>& shapes) {
  const auto& p = tire.p;
  const R &dfz = o.dfz, &dpi = o.dpi;
  const R gamma_star = upright ? R(0.0) : R(o.gamma_star * (tire.mf52 ? p.LGAY : 1.0));
  PureLateral<R> y;
  R zeta3 = R(1.0);
  y.zeta2 = R(1.0);
  if (conventions.turn_slip) {
    zeta3 = cos_atan(p.PKYP1 * p.UNLOADED_RADIUS * p.UNLOADED_RADIUS * o.phi * o.phi);  // (4.79)
    y.zeta2 = peak_reduction_by_spin(p, o);
  }
  y.Kya = cornering_stiffness(tire, o, gamma_star, upright ? o.sin_K0 : o.sin_K, zeta3);  // (4.E25)
  if (!upright || conventions.turn_slip) y.per_Kya_prime = 1.0 / with_epsilon(y.Kya);     // (4.E39)
  const R SVyg =
      o.Fz * (p.PVY3 + p.PVY4 * dfz) * gamma_star * p.LKYC * o.LMUY_prime * y.zeta2;  // (4.E28)
  // Camber causes no shift if the wheel is upright and moves on a straight path.
  const R by_camber =
      upright && !conventions.turn_slip
          ? R(0.0)
          : shift_by_camber(tire, conventions, o, gamma_star, SVyg, y.per_Kya_prime, zeta3);
  y.SHy = ((p.PHY1 + p.PHY2 * dfz) * p.LHY + by_camber) * o.fade;  // (4.E27)
  y.SVy =
      (o.Fz * (p.PVY1 + p.PVY2 * dfz) * p.LVY * o.LMUY_prime * y.zeta2 + SVyg) * o.fade;  // (4.E29)
  const R alphay = o.alpha_star + y.SHy;                                                  // (4.E20)
  y.Cy = R(p.PCY1 * p.LCY);                                                               // (4.E21)
  y.muy = (p.PDY1 + p.PDY2 * dfz) * (1.0 + p.PPY3 * dpi + p.PPY4 * dpi * dpi) *
          (1.0 - p.PDY3 * gamma_star * gamma_star) * o.LMUY_star;  // (4.E23)
  y.Dy = y.muy * o.Fz * y.zeta2;                                   // (4.E22)
  R Ey = (p.PEY1 + p.PEY2 * dfz) *
         (1.0 + p.PEY5 * gamma_star * gamma_star -
          (p.PEY3 + p.PEY4 * gamma_star) * sign_or_one(alphay)) *
         p.LEY;  // (4.E24)
  if (conventions.limits) Ey = at_most_one(Ey);
  y.By = y.Kya / (y.Cy * y.Dy + epsilon_for(y.Dy));  // (4.E26)
  shapes.set(upright ? Shapes<R>::kFyUpright : Shapes<R>::kFy, y.By * alphay, y.Cy, Ey);
  y.muy = select(o.Fz == 0.0, R(0.0), y.muy);
  return y;
}

template <class R>
LATSCH_INLINE void finish(const Conventions& conventions,
                          const OperatingPoint<R>& o,
                          const R& sine,
                          PureLateral<R>& y) {
  y.Fy0 = y.Dy * sine + y.SVy;  // (4.E19)
  if (conventions.angles == Angles::tangent) y.Fy0 = select(o.Vx < 0.0, -y.Fy0, y.Fy0);
}

template <class R>
struct CombinedLateral {
  R Fy, Gyk, SVyk;
};

/// Computes S_Vyk and the arguments of the two weighting curves for combined slip.
template <class R>
LATSCH_INLINE CombinedLateral<R> combined_lateral_terms(const TireOf<R>& tire,
                                                        const Conventions& conventions,
                                                        const OperatingPoint<R>& o,
                                                        const PureLateral<R>& pure,
                                                        Shapes<R>& shapes) {
  const auto& p = tire.p;
  CombinedLateral<R> y;
  const R DVyk = pure.muy * o.Fz * (p.RVY1 + p.RVY2 * o.dfz + p.RVY3 * o.gamma_star) * o.cos_RVY4 *
                 pure.zeta2;                     // (4.E67)
  y.SVyk = DVyk * o.sin_RVY * p.LVYKA * o.fade;  // (4.E66)
  const R SHyk = p.RHY1 + p.RHY2 * o.dfz;        // (4.E65)
  R Eyk = p.REY1 + p.REY2 * o.dfz;               // (4.E64)
  if (conventions.limits) Eyk = at_most_one(Eyk);
  const R Cyk = R(p.RCY1);                                                              // (4.E63)
  const R Byk = (p.RBY1 + p.RBY4 * o.gamma_star * o.gamma_star) * o.cos_RBY2 * p.LYKA;  // (4.E62)
  shapes.set(Shapes<R>::kGy0, Byk * SHyk, Cyk, Eyk);
  shapes.set(Shapes<R>::kGy, Byk * (o.kappa + SHyk), Cyk, Eyk);  // (4.E61)
  return y;
}

template <class R>
LATSCH_INLINE void finish(const Shapes<R>& shapes,
                          const PureLateral<R>& pure,
                          CombinedLateral<R>& y) {
  y.Gyk = shapes.cosine[Shapes<R>::kGy] / shapes.cosine[Shapes<R>::kGy0];  // (4.E59), (4.E60)
  y.Fy = y.Gyk * pure.Fy0 + y.SVyk;                                        // (4.E58)
}

}  // namespace latsch::magic_formula::LATSCH_KERNELS
#endif
