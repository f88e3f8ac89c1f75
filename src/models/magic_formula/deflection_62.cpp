// SPDX-License-Identifier: Apache-2.0
#include "models/magic_formula/deflection_62.h"

#include <cmath>

#include "models/magic_formula/magic_formula.h"
#include "models/magic_formula/vertical/load_curve.h"

namespace latsch::magic_formula {
namespace {

/// Returns the factor 1 + q_V2 |omega| R0/V0 - (q_FCx Fx/Fz0)^2 - (q_FCy Fy/Fz0)^2 of the vertical
/// force in (3).
template <class K>
K stiffening(const TireConstantsOf<K>& tire, const K& omega, const K& x, const K& y) {
  using std::abs;
  return 1.0 + tire.p.Q_V2 * tire.R0_per_V0 * abs(omega) - x * x - y * y;
}

template <class K>
K at_least(const K& x, double lower) {
  return x < lower ? K(lower) : x;
}

}  // namespace

/// Returns the vertical force Fz at the deflection rho_z = rho_zfr + rho_zg:
///   Fz = [1 + q_V2 |omega| R0/V0 - (q_FCx Fx/Fz0)^2
///         - ((rho_z/R0)^q_FCy2 q_FCy (Fy - S_Fyg)/Fz0)^2]
///        (q_Fz1 rho_z/R0 + q_Fz2 (rho_z/R0)^2) (1 + p_Fz1 dp) Fz0
template <class K>
K vertical_force_62(const TireConstantsOf<K>& tire,
                    const WheelUnderLoadOf<K>& o,
                    const K& R_l,
                    const K& Fx,
                    const K& Fy,
                    K* rho) {
  using std::abs, std::tan, std::pow;
  const auto& p = tire.p;
  const K R0 = p.UNLOADED_RADIUS, gamma = o.gamma;
  const K ratio = R_l / o.R_omega;
  const K SFyg = (p.Q_FYS1 + p.Q_FYS2 * ratio + p.Q_FYS3 * ratio * ratio) * gamma;
  const K rho_zfr = at_least(o.R_omega - R_l, 0.0);
  const K tread_width = (1.075 - 0.5 * p.ASPECT_RATIO) * p.WIDTH;
  K rho_zg = -p.Q_CAM3 * rho_zfr * abs(gamma);
  const K free = p.Q_CAM1 * o.R_omega + p.Q_CAM2 * o.R_omega * o.R_omega;
  if (value(free) != 0.0) {
    const K pressed = (p.Q_CAM1 * R_l + p.Q_CAM2 * R_l * R_l) / free;
    rho_zg = rho_zg + pressed * pressed * (tread_width / 8.0) * abs(tan(gamma));
  }
  constexpr double kLeast = 1e-12;  // m
  const K rho_z = at_least(rho_zfr + rho_zg, kLeast);
  if (rho != nullptr) *rho = rho_z;
  const K side = pow(rho_z / R0, p.Q_FCY2) * p.Q_FCY * (Fy - SFyg) / p.FNOMIN;
  return stiffening<K>(tire, o.omega, p.Q_FCX * Fx / p.FNOMIN, side) * (1.0 + p.PFZ1 * o.dpi) *
         (tire.Q_FZ1 * rho_z / R0 + p.Q_FZ2 * (rho_z / R0) * (rho_z / R0)) * p.FNOMIN;
}

Deflection62 deflection_62(const TireConstants& tire,
                           const WheelUnderLoad& o,
                           double Fx,
                           double Fy) {
  const auto surplus = [&](double R_l) {
    return vertical_force_62<double>(tire, o, R_l, Fx, Fy, nullptr) - o.Fz_given;
  };
  // The force decreases with the loaded radius, so the radius is reduced in steps until two values
  // bracket the load. With camber the shoulder of the tire touches the road even if the crown does
  // not, so the search may also go upward. If the force exceeds the load at every radius, the wheel
  // is at its free radius.
  const double step = 0.01 * tire.p.UNLOADED_RADIUS;
  double above = o.R_omega, f_above = surplus(above);
  double below = above, f_below = f_above;
  while (f_below < 0.0 && below > step) {
    above = below;
    f_above = f_below;
    below -= step;
    f_below = surplus(below);
  }
  while (f_above > 0.0 && above < o.R_omega + 4.5 * step) {
    below = above;
    f_below = f_above;
    above += step;
    f_above = surplus(above);
  }
  Deflection62 d;
  d.carried = !(f_above > 0.0 || f_below < 0.0);
  if (f_above > 0.0) above = below = o.R_omega;
  if (f_below < 0.0) {  // at no radius the tire carries the load
    d.R_l = 0.0;
  } else {
    for (int i = 0; i < 60 && above - below > 1e-15; ++i) {
      // Illinois method: a secant step in which the function value at the older end is halved, so
      // that both ends of the bracket move.
      double middle = (above * f_below - below * f_above) / (f_below - f_above);
      if (!(middle > below && middle < above)) middle = 0.5 * (below + above);
      const double f = surplus(middle);
      if (f == 0.0) below = above = middle;
      (f > 0.0 ? below : above) = middle;
      if (f > 0.0) {
        f_below = f;
        f_above *= 0.5;
      } else {
        f_above = f;
        f_below *= 0.5;
      }
    }
    d.R_l = 0.5 * (below + above);
  }
  vertical_force_62<double>(tire, o, d.R_l, Fx, Fy, &d.rho);
  return d;
}

DualDeflection62 deflection_62(const TireConstants& tire,
                               const TireConstantsOf<DualNumber>& dual_tire,
                               const WheelUnderLoadOf<DualNumber>& o,
                               const DualNumber& Fx,
                               const DualNumber& Fy,
                               int spare,
                               SlopeArena& arena) {
  const WheelUnderLoad plain{o.Fz.v, o.Fz_given.v, o.omega.v, o.gamma.v, o.dpi.v, o.R_omega.v};
  const Deflection62 found = deflection_62(tire, plain, Fx.v, Fy.v);
  DualDeflection62 d;
  d.R_l = found.R_l;
  if (found.carried) {
    const DualNumber radius = DualNumber::variable(found.R_l, spare, arena);
    const DualNumber surplus =
        vertical_force_62<DualNumber>(dual_tire, o, radius, Fx, Fy, nullptr) - o.Fz_given;
    const double stiffness = -surplus.slope(spare);
    // Without load the stiffness is zero, the tire barely touches the road, and R_l equals the free
    // radius.
    d.R_l = stiffness > 0.0 ? DualNumber(found.R_l, without(surplus, spare, 1.0 / stiffness))
                            : DualNumber(found.R_l, o.R_omega.slopes);
  } else if (found.R_l > 0.0) {
    d.R_l = o.R_omega;
  }
  vertical_force_62<DualNumber>(dual_tire, o, d.R_l, Fx, Fy, &d.rho);
  return d;
}

double MagicFormula::vertical_force(
    double rho, double omega, double gamma, double p, double Fx, double Fy) const {
  WheelUnderLoad o{};
  const Parameters& q = parameters_;
  if (has_load_curve(q)) return force_on_curve(q, rho);
  o.omega = omega;
  o.gamma = conventions_.mirrored ? -gamma : gamma;
  o.dpi = (p - q.NOMPRES) / q.NOMPRES;
  const double speed = omega * q.UNLOADED_RADIUS / q.LONGVL;
  o.R_omega = q.UNLOADED_RADIUS * (q.Q_RE0 + q.Q_V1 * speed * speed);  // (1)
  if (rho <= 0.0) return 0.0;
  if (q.version == Version::mf62)
    return vertical_force_62<double>(
        tire_, o, o.R_omega - rho, Fx, conventions_.mirrored ? -Fy : Fy, nullptr);
  const double x = rho / q.UNLOADED_RADIUS;
  return stiffening<double>(tire_, omega, q.Q_FCX * Fx / q.FNOMIN, q.Q_FCY * Fy / q.FNOMIN) *
         (tire_.Q_FZ1 * x + q.Q_FZ2 * x * x) * (1.0 + q.PFZ1 * o.dpi) * q.FNOMIN;
}

}  // namespace latsch::magic_formula
