// SPDX-License-Identifier: Apache-2.0
// Converts the caller's state to the inputs of the equations. This comprises limits, fading at low
// speed, alpha* and gamma*, normalized load and pressure, effective rolling radius and spin.
//
// (4.E...), (4.76) ...: [Pacejka 2012, ch. 4.3]; (A..) and (1)-(19): [Besselink et al. 2010].
// Signs: ISO-W (NOTATION.md); the book uses adapted SAE, so Vsy = + tan(alpha) |Vx| here.
#if defined(LATSCH_MAGIC_FORMULA_OPERATING_POINT) == defined(LATSCH_KERNEL_TOGGLE)
#ifdef LATSCH_MAGIC_FORMULA_OPERATING_POINT
#undef LATSCH_MAGIC_FORMULA_OPERATING_POINT
#else
#define LATSCH_MAGIC_FORMULA_OPERATING_POINT
#endif

#include "models/magic_formula/conventions.h"
#include "models/magic_formula/side_by_side.h"
#include "models/magic_formula/tire_constants.h"

namespace latsch::magic_formula::LATSCH_KERNELS {

using namespace latsch::LATSCH_KERNELS;

constexpr double kPi = 3.14159265358979323846;
/// Small number added to denominators to keep quotients finite. It is the book's epsilon_x, _K, _y,
/// _V (4.E6a, 4.E16, 4.E26, 4.E39).
constexpr double kEpsilon = 1e-6;

/// Returns kEpsilon with the sign of the denominator to which it is added; positive if the
/// denominator is 0.
template <class R>
LATSCH_INLINE R epsilon_for(const R& denominator) {
  return with_sign(R(kEpsilon), denominator + R(0.0));
}

/// Returns the divisor, or `least` if it is 0. A file may contain 0 for a coefficient by which the
/// equations divide. The result is then that of a very small coefficient.
template <class R>
LATSCH_INLINE R not_zero(const R& divisor, double least = kEpsilon) {
  return select(divisor == 0.0, R(least), divisor);
}

/// Returns cos(atan x).
template <class R>
LATSCH_INLINE R cos_atan(const R& x) {
  return 1.0 / sqrt(1.0 + x * x);
}
template <class R>
LATSCH_INLINE R cos_atan(const Product<R>& x) {
  return cos_atan(R(x));
}

/// Computes cos(atan x) for three arguments at once.
LATSCH_INLINE void cosines_of_atan(
    const Lane& x, const Lane& y, const Lane& z, Lane& of_x, Lane& of_y, Lane& of_z) {
  const Lanes4 cosine = cos_atan(four(number(x), number(y), number(z), 0.0));
  of_x = cosine.at(0);
  of_y = cosine.at(1);
  of_z = cosine.at(2);
}
template <class R>
LATSCH_INLINE void cosines_of_atan(const R& x, const R& y, const R& z, R& of_x, R& of_y, R& of_z) {
  of_x = cos_atan(x);
  of_y = cos_atan(y);
  of_z = cos_atan(z);
}

template <class R>
struct OperatingPoint {
  R Fz, Fz_given;  // load limited to FZMAX; load as given
  R Fz_moment;     // load limited to FZMIN as well, for trail and residual torque
  R kappa, kappa_given, alpha, gamma, phit, Vx, p;
  R fade;     // factor on the forces: 0 at standstill, 1 from VXLOW on
  R sign_Vx;  // -1, 0, 1
  R tan_alpha;
  R alpha_star, gamma_star, dfz, dpi;
  R cos_alpha, cos_alpha_star, cos_alpha_prime;
  R cos_RBX2, cos_RBY2, cos_RVY4;  // cosines cos(atan ...) in (4.E54), (4.E62), (4.E67)
  R LMUX_star, LMUY_star, LMUX_prime, LMUY_prime, per_LMUY_star;
  R per_Cz;  // m/N
  R Re, R_omega, omega;
  R epsilon_gamma, phi;  // used only with turn slip
  // Functions of the state alone, which are evaluated together.
  R atan_load;      // atan(BREFF Fz/Fz0)
  R sin_K, sin_K0;  // sin(PKY4 atan(...)) in (4.E25), with and without camber
  R sin_RVY;        // sin(RVY5 atan(RVY6 kappa))
  R exp_PKX3;
  R Fz_My, load_power, pressure_power;  // (Fz/Fz0)^QSY7 (p/p0)^QSY8
  R patch_load, patch_root;             // Fz/(Cz R0) and its cube root
};

template <class R>
LATSCH_INLINE R clamped(const R& x, const ConstantOf<R>& lower, const ConstantOf<R>& upper) {
  return larger(smaller(x, R(upper)), R(lower));
}

/// Returns the curvature factor E limited to 1. At E = 1 the derivative is that of the unlimited
/// side, so that a fit can leave this bound.
template <class R>
LATSCH_INLINE R at_most_one(const R& E) {
  return select(E <= 1.0, E, R(1.0));
}

template <class R>
LATSCH_INLINE void apply_limits(const TireOf<R>& tire,
                                const Conventions& conventions,
                                OperatingPoint<R>& o) {
  const auto& p = tire.p;
  const R slow = p.VXLOW > 0.0 ? smaller(abs(o.Vx) * tire.per_VXLOW, R(1.0)) : R(1.0);
  const auto crawls = slow < 1.0;
  o.fade = R(1.0);
  if (any(crawls)) {
    o.fade = select(crawls, 0.5 * (1.0 - cos(kPi * slow)), o.fade);
    const SinCos<R> a = sin_cos(o.alpha);
    const R speed = abs(o.Vx) + abs(a.sin / a.cos * o.Vx);
    o.phit = o.phit * slow;
    o.alpha = o.alpha * smaller(speed * tire.per_VXLOW, R(1.0));
    o.kappa = o.kappa * slow;
  }
  if (conventions.turn_slip) o.phit = o.phit * sign_or_one(o.Vx);
  o.alpha = clamped(o.alpha, p.ALPMIN, p.ALPMAX);
  o.gamma = clamped(o.gamma, p.CAMMIN, p.CAMMAX);
  o.kappa = clamped(o.kappa, p.KPUMIN, p.KPUMAX);
  o.p = clamped(o.p, p.PRESMIN, p.PRESMAX);
  o.Fz = smaller(o.Fz, R(p.FZMAX));
  o.Fz_moment = select(o.Fz > 0.0, larger(o.Fz, R(p.FZMIN)), R(0.0));
}

/// Returns the load with which moments are computed. Below FZMIN it fades with a power of Fz/FZMIN.
template <class R>
LATSCH_INLINE R faded_load(const TireOf<R>& tire, const R& Fz, bool squared) {
  if (!(tire.p.FZMIN > 0.0)) return Fz;
  const R share = Fz * tire.per_FZMIN;
  return select(Fz < tire.p.FZMIN, Fz * (squared ? share * share : share), Fz);
}

/// Returns the argument of the arc tangent in the cornering stiffness (4.E25).
template <class R>
LATSCH_INLINE R bend(const TireOf<R>& tire, const OperatingPoint<R>& o, const R& gamma_star) {
  const auto& p = tire.p;
  constexpr double kTiny = 1e-300;  // for divisors this small the arc tangent is pi/2
  return (o.Fz * tire.per_Fz0_prime) /
         not_zero<R>((p.PKY2 + p.PKY5 * gamma_star * gamma_star) * (1.0 + p.PPY2 * o.dpi), kTiny);
}

template <class R>
LATSCH_INLINE void powers(const TireOf<R>& tire, OperatingPoint<R>& o) {
  const auto& p = tire.p;
  const R one = R(1.0), zero = R(0.0);
  const ConstantOf<R> R0 = p.UNLOADED_RADIUS;
  // The contact patch does not grow any more once the rim carries the load.
  o.patch_load = smaller(o.Fz_given * o.per_Cz, R(R0 - p.RIM_RADIUS - p.BOTTOM_OFFST)) * (1.0 / R0);
  o.Fz_My = faded_load(tire, o.Fz_given, false);
  const R load = o.Fz_My * tire.per_FNOMIN, pressure = o.p * tire.per_NOMPRES;
  const R bases[3] = {select(load > 0.0, load, one),
                      select(pressure > 0.0, pressure, one),
                      select(o.patch_load > 0.0, o.patch_load, one)};
  const ConstantOf<R> powers[3] = {p.QSY7, p.QSY8, 1.0 / 3.0};
  R raised[3];
  powers_and_exp(bases, powers, R(p.PKX3 * o.dfz), raised, o.exp_PKX3);
  o.load_power = select(load > 0.0, raised[0], R(p.QSY7 == 0.0 ? 1.0 : 0.0));
  o.pressure_power = select(pressure > 0.0, raised[1], R(p.QSY8 == 0.0 ? 1.0 : 0.0));
  o.patch_root = select(o.patch_load > 0.0, raised[2], zero);
}

template <class R>
LATSCH_INLINE void functions_of_state(const TireOf<R>& tire, OperatingPoint<R>& o) {
  const auto& p = tire.p;
  const R gamma_star = o.gamma_star * (tire.mf52 ? p.LGAY : 1.0);
  const R arguments[4] = {bend(tire, o, gamma_star),
                          bend<R>(tire, o, R(0.0)),
                          p.RVY6 * o.kappa,
                          p.BREFF * (o.Fz_given * tire.per_FNOMIN)};
  const ConstantOf<R> factors[3] = {p.PKY4, p.PKY4, p.RVY5};
  R arcs[4], sine[4], cosine[4];
  sin_cos_of_atan_all(arguments, factors, o.alpha, arcs, sine, cosine);
  o.atan_load = arcs[3];
  o.sin_K = sine[0];
  o.sin_K0 = sine[1];
  o.sin_RVY = sine[2];
  o.tan_alpha = sine[3] / cosine[3];
  o.cos_alpha = cosine[3];
}

/// Returns the solution x >= 1 of x^3 - x^2 = e, for e >= 0, by Newton's method. It starts from the
/// power series in e, or, if the series is not accurate, from a value above the solution.
template <class R>
LATSCH_INLINE R stretched(const R& e) {
  constexpr double kSeries = 0.05;
  const R series = 1.0 + e * (1.0 + e * (-2.0 + e * (7.0 + e * (-30.0 + e * 143.0))));
  R x = select(e < kSeries, series, 1.0 + e);
  for (int i = 0; i < 60; ++i) {
    const R step = (x * x * (x - 1.0) - e) / (x * (3.0 * x - 2.0));
    x = x - step;
    // After a Newton step the error is about twice the square of the step.
    if (!any(abs(step) > 1e-8 * x)) break;
  }
  return x;
}

/// Derivatives carried through the iteration would lag by one step, so they are computed from the
/// equation itself.
template <class V>
LATSCH_INLINE DualLanes<V> stretched(const DualLanes<V>& e) {
  const V x = stretched(e.v);
  if (e.slopes == nullptr) return {x, nullptr};
  return {x, scaled<V>(e.slopes, 1.0 / (x * (3.0 * x - 2.0)))};
}

/// Computes effective rolling radius and spin, which depend on each other:
///   Re = R_omega - deflection terms (7),  R_omega = R0 (q_re0 + q_V1 (omega R0/V0)^2) (1),
///   omega = (1 + kappa) Vx / Re
template <class R>
LATSCH_INLINE void roll(const TireOf<R>& tire, OperatingPoint<R>& o) {
  const auto& p = tire.p;
  const R load = o.Fz_given * tire.per_FNOMIN;
  const R slack = p.FNOMIN * o.per_Cz * (p.DREFF * o.atan_load + p.FREFF * load);
  const R speed = (1.0 + o.kappa_given) * o.Vx;
  const R growth = (p.UNLOADED_RADIUS * p.Q_V1 * tire.R0_per_V0 * tire.R0_per_V0) * speed * speed;
  // The radius has a lower limit, so that even a load which the tire cannot carry gives a positive
  // rolling radius.
  constexpr double kSmallestRadius = 0.01;
  const R still =
      larger(p.UNLOADED_RADIUS * p.Q_RE0 - slack, R(kSmallestRadius * p.UNLOADED_RADIUS));
  o.Re = still * stretched(growth / (still * still * still));
  o.omega = speed / o.Re;
  o.R_omega = o.Re + slack;
}

/// Computes the spin of the tire by its curved path and by camber (4.76), and the camber reduction
/// factor (4.90). `of_book`: conventions.h.
template <class R>
LATSCH_INLINE void spin(const CoefficientsFor<R>& p, bool of_book, OperatingPoint<R>& o) {
  o.epsilon_gamma = p.PECP1 * (1.0 + p.PECP2 * o.dfz);  // (4.90)
  const R V = abs(o.Vx) * sqrt(1.0 + o.tan_alpha * o.tan_alpha);
  const R Vc_prime = select(abs(o.Vx) < p.VXLOW, p.VXLOW * sign_or_one(o.Vx), V);
  // The z axis points up here, so the turn slip has the opposite sign of the book's (4.75).
  const R by_camber =
      (1.0 - o.epsilon_gamma) * o.omega * sin(o.gamma) / not_zero<R>(Vc_prime);  // (4.76)
  o.phi = of_book ? -o.phit + by_camber : -o.phit - by_camber;
}

template <class R>
LATSCH_INLINE void friction_scales(const TireOf<R>& tire, double A_mu, OperatingPoint<R>& o) {
  const auto& p = tire.p;
  o.LMUX_star = R(p.LMUX);
  o.LMUY_star = R(p.LMUY);
  o.per_LMUY_star = R(tire.per_LMUY);
  if (matters(p.LMUV)) {
    const R Vs = abs(o.Vx) * sqrt(o.kappa * o.kappa + o.tan_alpha * o.tan_alpha);
    const R slippery = 1.0 + p.LMUV * Vs * tire.per_LONGVL;
    o.LMUX_star = p.LMUX / slippery;  // (4.E7)
    o.LMUY_star = p.LMUY / slippery;
    o.per_LMUY_star = 1.0 / not_zero<R>(o.LMUY_star);
  }
  o.LMUX_prime = o.LMUX_star;
  o.LMUY_prime = o.LMUY_star;
  if (A_mu == 1.0) return;
  o.LMUX_prime = A_mu * o.LMUX_star / (1.0 + (A_mu - 1.0) * o.LMUX_star);  // (4.E8)
  o.LMUY_prime = A_mu * o.LMUY_star / (1.0 + (A_mu - 1.0) * o.LMUY_star);
}

template <class R>
LATSCH_INLINE void find_operating_point(const TireOf<R>& tire,
                                        const Conventions& conventions,
                                        const StateOf<R>& given,
                                        OperatingPoint<R>& o) {
  const auto& p = tire.p;
  o.Fz = o.Fz_given = o.Fz_moment = larger(given.Fz, R(0.0));
  o.kappa = o.kappa_given = given.kappa;
  o.alpha = given.alpha;
  o.gamma = given.gamma;
  o.phit = given.phit;
  o.Vx = given.Vx;
  o.p = given.p;
  o.fade = R(1.0);
  if (conventions.limits) {
    if (conventions.turn_slip) o.phit = o.phit * cos(o.alpha);
    apply_limits(tire, conventions, o);
  }
  o.sign_Vx = sign(o.Vx);
  o.epsilon_gamma = o.phi = R(0.0);
  const bool tangent = conventions.angles == Angles::tangent;
  o.gamma_star = tangent ? sin(o.gamma) : o.gamma;                   // (4.E4)
  o.dfz = (o.Fz - tire.Fz0_prime) * tire.per_Fz0_prime;              // (4.E2a)
  o.dpi = (o.p - p.NOMPRES) * tire.per_NOMPRES;                      // (4.E2b)
  o.per_Cz = 1.0 / (p.VERTICAL_STIFFNESS * (1.0 + p.PFZ1 * o.dpi));  // (5)
  powers(tire, o);
  functions_of_state(tire, o);
  o.alpha_star = tangent ? o.tan_alpha * o.sign_Vx : o.alpha;  // (4.E3)
  o.cos_alpha_star = tangent ? cos(o.alpha_star) : o.cos_alpha;
  cosines_of_atan<R>(p.RBX2 * o.kappa,
                     p.RBY2 * (o.alpha_star - p.RBY3),
                     p.RVY4 * o.alpha_star,
                     o.cos_RBX2,
                     o.cos_RBY2,
                     o.cos_RVY4);
  const R Vc = abs(o.Vx) * sqrt(1.0 + o.tan_alpha * o.tan_alpha);
  o.cos_alpha_prime = o.Vx / (Vc + kEpsilon);  // (4.E6)
  friction_scales(tire, conventions.A_mu, o);
  roll(tire, o);
  if (conventions.turn_slip) spin(p, conventions.spin_of_book, o);
}

/// The curves of one state, each of the form C atan(Bx - E (Bx - atan Bx)) (4.E9). They are
/// evaluated four at a time.
template <class R>
struct Shapes {
  enum { kFy, kFyUpright, kGy, kGy0, kFx, kGx, kGx0, kTrail, kCount };
  enum Four { kLateral = kFy, kOthers = kFx };
  R Bx[kCount], C[kCount], E[kCount];
  R sine[kCount], cosine[kCount];
  decltype(inner_arcs(Bx)) arcs[2];

  LATSCH_INLINE void set(int which, const R& Bx_, const R& C_, const R& E_) {
    Bx[which] = Bx_;
    C[which] = C_;
    E[which] = E_;
  }
  LATSCH_INLINE void begin(Four i) { arcs[i / 4] = inner_arcs(Bx + i); }
  LATSCH_INLINE void end(Four i) {
    magic_of_four(Bx + i, C + i, E + i, arcs[i / 4], sine + i, cosine + i);
  }
};

/// Returns sin(C atan(Bx - E (Bx - atan(Bx)))), a single curve of the Magic Formula.
template <class R>
LATSCH_INLINE R sine_shape(const R& Bx, const R& C, const R& E) {
  return sin(C * atan(Bx - E * (Bx - atan(Bx))));
}
}  // namespace latsch::magic_formula::LATSCH_KERNELS
#endif
