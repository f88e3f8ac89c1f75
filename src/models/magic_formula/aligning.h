// SPDX-License-Identifier: Apache-2.0
// The aligning moment: pneumatic trail, residual torque, arm of the longitudinal force.
//
// (4.E31)-(4.E49), (4.E71)-(4.E78) [Pacejka 2012] in the form of [Besselink et al. 2010]: trail
// (A58), (A60) with gamma in place of the book's |gamma|, equivalent slip angles (A54), (A55), arm
// s (A56). The trail contains LFZO, as in MF-Tyre. MF 5.2 multiplies the trail by the actual side
// force, 6.1 and 6.2 by that at gamma = 0 (4.E74). MF 5.2 has the inclination times LGAZ in every
// term but the arm s. The torque of turning on the spot and of turn slip is (4.91)-(4.103); (4.93)
// has the turn slip alone and (4.99) is evaluated as in MF-Tyre, unless the conventions ask for the
// spin of the book: it keeps the torque of camber, too.
#if defined(LATSCH_MAGIC_FORMULA_ALIGNING) == defined(LATSCH_KERNEL_TOGGLE)
#ifdef LATSCH_MAGIC_FORMULA_ALIGNING
#undef LATSCH_MAGIC_FORMULA_ALIGNING
#else
#define LATSCH_MAGIC_FORMULA_ALIGNING
#endif

#include "models/magic_formula/lateral.h"

namespace latsch::magic_formula::LATSCH_KERNELS {

template <class R>
struct Aligning {
  R Mz, t, Mzr;
  R Dt, alphar_eq;
};

/// Effects of spin on the residual torque: the change of its peak (4.E47) and of its shape (4.E45),
/// (4.E46).
template <class R>
struct SpinTorque {
  R zeta6, Drp;
  R share;  // Mz_phi90 / |D_rphi|, whose arc cosine determines zeta_7 (4.100)
};

/// Returns cos(2/pi acos(x) a). For x > 1 it returns the analytic continuation, with acos x = i
/// arcosh x.
template <class R>
LATSCH_INLINE R cosine_of_share(const R& x, const R& a) {
  const R inside = smaller(x, R(1.0));
  const R angle = 2.0 * atan(sqrt((1.0 - inside) / (1.0 + inside)));  // acos
  const R above = larger(x, R(1.0));
  const R y = 2.0 / kPi * log(above + sqrt(above * above - 1.0)) * a;
  return select(x > 1.0, 0.5 * (exp(y) + exp(-y)), cos(2.0 / kPi * angle * a));
}

template <class R>
LATSCH_INLINE SpinTorque<R> spin_torque(const TireOf<R>& tire,
                                        const Conventions& conventions,
                                        const OperatingPoint<R>& o,
                                        const PureLateral<R>& y,
                                        const R& Gyk) {
  const auto& p = tire.p;
  const ConstantOf<R> R0 = p.UNLOADED_RADIUS;
  SpinTorque<R> s;
  s.zeta6 = cos_atan(p.QBRP1 * R0 * o.phi);  // (4.102)
  const R& Fz = o.Fz_moment;
  const R none = R(kEpsilon);
  const R at_rest = p.QCRP1 * abs(y.muy) * R0 * Fz * sqrt(Fz * tire.per_Fz0_prime) * p.LMP;
  const R Mzp_inf = select(at_rest > 0.0, at_rest, none);  // (4.95)
  const ConstantOf<R> CDrp = p.QDRP1;                      // (4.96)
  const R DDrp = Mzp_inf / sin(R(0.5 * kPi * CDrp));       // (4.94)
  const bool of_book = conventions.spin_of_book;
  const R by_gamma = of_book
                         ? R((p.QDZ8 + p.QDZ9 * o.dfz) * (1.0 + p.PPZ2 * o.dpi) +
                             (p.QDZ10 + p.QDZ11 * o.dfz) * abs(o.gamma))
                         : R(p.QDZ8 * p.QDZ9 * o.dfz + (p.QDZ10 + p.QDZ11 * o.dfz * abs(o.gamma)));
  const R Kzgr0 = Fz * R0 * by_gamma * p.LKZC;                                     // (4.99)
  const R BDrp = Kzgr0 / (CDrp * DDrp * not_zero<R>(1.0 - o.epsilon_gamma));       // (4.98)
  s.Drp = DDrp * sin(CDrp * atan(BDrp * R0 * (of_book ? o.phi : o.phit)));         // (4.93)
  const R Mzp90 = Mzp_inf * (2.0 / kPi) * atan(p.QCRP2 * R0 * abs(o.phit)) * Gyk;  // (4.103)
  // On a straight path numerator and denominator of the quotient Mz_phi90 / |D_rphi| vanish. Its
  // limit is the quotient of their derivatives.
  const R straight = Mzp_inf * (2.0 / kPi) * p.QCRP2 * Gyk / abs(BDrp * CDrp * DDrp);
  // Without load both torques vanish, and the quotient is set to 1.
  s.share = select(Fz == 0.0, R(1.0), select(s.Drp == 0.0, straight, Mzp90 / abs(s.Drp)));
  // If the stiffness against spin is zero, the quotient in (4.100) is infinite, and near zero it
  // has no physical meaning. It is then set to 1, and the residual torque does not depend on the
  // slip angle.
  constexpr double kMostShare = 1e6;
  s.share = select(s.share < kMostShare, s.share, R(1.0));
  return s;
}

template <class R>
LATSCH_INLINE R residual_peak(const TireOf<R>& tire,
                              const Conventions& conventions,
                              const OperatingPoint<R>& o,
                              const R& zeta2) {
  const auto& p = tire.p;
  const R g = o.gamma_star * (tire.mf52 ? p.LGAZ : 1.0);
  const R camber =
      ((p.QDZ8 + p.QDZ9 * o.dfz) * (1.0 + p.PPZ2 * o.dpi) + (p.QDZ10 + p.QDZ11 * o.dfz) * abs(g)) *
      g * p.LKZC;
  const double zeta0 = conventions.turn_slip ? 0.0 : 1.0;  // (4.83)
  return o.Fz_moment * p.UNLOADED_RADIUS *
         ((p.QDZ6 + p.QDZ7 * o.dfz) * p.LRES * zeta2 + camber * zeta0) * o.LMUY_star * o.sign_Vx *
         o.cos_alpha_star;  // the cosine of (4.E47), without zeta_8 - 1
}

/// Computes atan sqrt(tan^2 angle + drag^2) for two slip angles, and the arc tangent of `third`.
/// Meanwhile the evaluation of the side force's curves begins, so that the processor overlaps both.
LATSCH_INLINE void equivalent_angles(const Lane (&angles)[2],
                                     const Lane& drag,
                                     const Lane& third,
                                     Shapes<Lane>& shapes,
                                     Lane (&arcs)[3]) {
  const SinCos<Lanes4> a = sin_cos(four(angles[0].v, angles[1].v, 0.0, 0.0));
  shapes.begin(Shapes<Lane>::kLateral);
  const Lanes4 of_drag = Lanes4(drag.v) * a.cos;
  const Lanes4 opposite = sqrt(a.sin * a.sin + of_drag * of_drag), adjacent = abs(a.cos);
  const auto last = four(0.0, 0.0, 1.0, 1.0) > 0.0;
  const Lanes4 arc = atan_of_quotient(select(last, Lanes4(third.v), opposite),
                                      select(last, Lanes4(1.0), adjacent));
  for (int i = 0; i < 3; ++i) arcs[i] = arc.at(i);
}
template <class R>
LATSCH_INLINE void equivalent_angles(
    const R (&angles)[2], const R& drag, const R& third, Shapes<R>& shapes, R (&arcs)[3]) {
  shapes.begin(Shapes<R>::kLateral);
  for (int i = 0; i < 2; ++i) {
    const SinCos<R> a = sin_cos(angles[i]);
    const R of_drag = drag * a.cos;
    arcs[i] = atan_of_quotient(sqrt(a.sin * a.sin + of_drag * of_drag), abs(a.cos));
  }
  arcs[2] = atan(third);
}

/// Computes the terms of the aligning moment that need no other forces. The arguments of the
/// trail's curve are written to `shapes`, which must already contain those of the side force's
/// curves. The evaluation of these curves begins here.
template <class R>
LATSCH_INLINE Aligning<R> aligning_terms(const TireOf<R>& tire,
                                         const Conventions& conventions,
                                         const OperatingPoint<R>& o,
                                         const PureLateral<R>& pure,
                                         const R& Kxk,
                                         Shapes<R>& shapes) {
  const auto& p = tire.p;
  const R &dfz = o.dfz, &dpi = o.dpi;
  const R gamma = o.gamma * (tire.mf52 ? p.LGAZ : 1.0);
  const R gamma_star = o.gamma_star * (tire.mf52 ? p.LGAZ : 1.0);
  Aligning<R> z;
  const R SHt = p.QHZ1 + p.QHZ2 * dfz + (p.QHZ3 + p.QHZ4 * dfz) * gamma_star;  // (4.E35)
  const R alphat = o.alpha_star + SHt;                                         // (4.E34)
  const R alphar = o.alpha_star + pure.SHy + pure.SVy * pure.per_Kya_prime;    // (4.E37), (4.E38)
  const R Bt = (p.QBZ1 + p.QBZ2 * dfz + p.QBZ3 * dfz * dfz) *
               (1.0 + p.QBZ4 * gamma + p.QBZ5 * abs(gamma)) * p.LKY * o.per_LMUY_star;  // (A58)
  const R Ct = R(p.QCZ1);                                                               // (4.E41)
  z.Dt = (p.QDZ1 + p.QDZ2 * dfz) * (1.0 - p.PPZ1 * dpi) *
         (1.0 + p.QDZ3 * gamma + p.QDZ4 * gamma * gamma) * o.Fz_moment *
         (p.UNLOADED_RADIUS * tire.per_Fz0_prime) * p.LTR;  // (A60)

  const R angles[2] = {alphar, alphat};
  const R drag = Kxk * pure.per_Kya_prime * o.kappa;
  R arcs[3];
  equivalent_angles(angles, drag, R(Bt * Ct * alphat), shapes, arcs);
  z.alphar_eq = select(alphar == 0.0, R(0.0), with_sign(arcs[0], alphar));        // (A54)
  const R alphat_eq = select(alphat == 0.0, R(0.0), with_sign(arcs[1], alphat));  // (A55)
  R Et = (p.QEZ1 + p.QEZ2 * dfz + p.QEZ3 * dfz * dfz) *
         (1.0 + (p.QEZ4 + p.QEZ5 * gamma_star) * (2.0 / kPi) * arcs[2]);
  if (conventions.limits) Et = at_most_one(Et);  // (4.E44)
  shapes.set(Shapes<R>::kTrail, Bt * alphat_eq, Ct, Et);
  return z;
}

template <class R>
LATSCH_INLINE void finish(const TireOf<R>& tire,
                          const Conventions& conventions,
                          const OperatingPoint<R>& o,
                          const PureLateral<R>& pure,
                          const R& upright_Fy0,
                          const CombinedLateral<R>& combined,
                          const R& Fx,
                          const Shapes<R>& shapes,
                          Aligning<R>& z) {
  const auto& p = tire.p;
  const ConstantOf<R> R0 = p.UNLOADED_RADIUS;
  SpinTorque<R> turning{R(1.0), R(0.0), R(0.0)};
  R zeta5 = R(1.0);
  if (conventions.turn_slip) {
    zeta5 = cos_atan(p.QDTP1 * R0 * o.phi);  // (4.91)
    turning = spin_torque(tire, conventions, o, pure, combined.Gyk);
  }
  const R Dr = residual_peak(tire, conventions, o, pure.zeta2) + turning.Drp;  // (4.E47)
  const R Br =
      (p.QBZ9 * p.LKY * o.per_LMUY_star + p.QBZ10 * pure.By * pure.Cy) * turning.zeta6;  // (4.E45)
  const R cosine = conventions.turn_slip ? cosine_of_share<R>(turning.share, atan(Br * z.alphar_eq))
                                         : cos_atan<R>(Br * z.alphar_eq);
  z.Mzr = Dr * cosine * o.fade;  // (4.E75)
  z.t = z.Dt * zeta5 * shapes.cosine[Shapes<R>::kTrail] * o.cos_alpha_prime * p.LFZO *
        o.fade;  // (4.E73)
  const R s =
      R0 * (p.SSZ1 + p.SSZ2 * combined.Fy * tire.per_FNOMIN + (p.SSZ3 + p.SSZ4 * o.dfz) * o.gamma) *
      p.LS;                                                                             // (A56)
  const R side = tire.mf52 ? combined.Fy - combined.SVyk : combined.Gyk * upright_Fy0;  // (4.E74)
  z.Mz = -z.t * side + z.Mzr + s * Fx;                                                  // (4.E71)
}

}  // namespace latsch::magic_formula::LATSCH_KERNELS
#endif
