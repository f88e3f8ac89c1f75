// SPDX-License-Identifier: Apache-2.0
#include "models/magic_formula/deflection_62.h"

#include <algorithm>
#include <cmath>

#include "models/magic_formula/magic_formula.h"

namespace latsch::magic_formula {
namespace {

/// 1 + q_V2 |omega| R0/V0 - (q_FCx Fx/Fz0)^2 - (q_FCy Fy/Fz0)^2 (3)
double stiffening(const TireConstants& tire, double omega, double x, double y) {
  return 1.0 + tire.p.Q_V2 * tire.R0_per_V0 * std::abs(omega) - x * x - y * y;
}

}  // namespace

/// rho_z = rho_zfr + rho_zg; Fz = [1 + q_V2 |omega| R0/V0 - (q_FCx Fx/Fz0)^2 - ((rho_z/R0)^q_FCy2
/// q_FCy (Fy - S_Fyg)/Fz0)^2] (q_Fz1 rho_z/R0 + q_Fz2 (rho_z/R0)^2) (1 + p_Fz1 dp) Fz0.
double vertical_force_62(const TireConstants& tire,
                         const WheelUnderLoad& o,
                         double R_l,
                         double Fx,
                         double Fy,
                         double* rho) {
  const Parameters& p = tire.p;
  const double R0 = p.UNLOADED_RADIUS, gamma = o.gamma;
  const double ratio = R_l / o.R_omega;
  const double SFyg = (p.Q_FYS1 + p.Q_FYS2 * ratio + p.Q_FYS3 * ratio * ratio) * gamma;
  const double rho_zfr = std::max(o.R_omega - R_l, 0.0);
  const double tread_width = (1.075 - 0.5 * p.ASPECT_RATIO) * p.WIDTH;
  double rho_zg = -p.Q_CAM3 * rho_zfr * std::abs(gamma);
  const double free = p.Q_CAM1 * o.R_omega + p.Q_CAM2 * o.R_omega * o.R_omega;
  if (free != 0.0) {
    const double pressed = (p.Q_CAM1 * R_l + p.Q_CAM2 * R_l * R_l) / free;
    rho_zg += pressed * pressed * (tread_width / 8.0) * std::abs(std::tan(gamma));
  }
  constexpr double kLeast = 1e-12;  // m
  const double rho_z = std::max(rho_zfr + rho_zg, kLeast);
  if (rho != nullptr) *rho = rho_z;
  const double side = std::pow(rho_z / R0, p.Q_FCY2) * p.Q_FCY * (Fy - SFyg) / p.FNOMIN;
  return stiffening(tire, o.omega, p.Q_FCX * Fx / p.FNOMIN, side) * (1.0 + p.PFZ1 * o.dpi) *
         (tire.Q_FZ1 * rho_z / R0 + p.Q_FZ2 * (rho_z / R0) * (rho_z / R0)) * p.FNOMIN;
}

Deflection62 deflection_62(const TireConstants& tire,
                           const WheelUnderLoad& o,
                           double Fx,
                           double Fy) {
  const auto surplus = [&](double R_l) {
    return vertical_force_62(tire, o, R_l, Fx, Fy, nullptr) - o.Fz_given;
  };
  // Smaller radii carry more: walk until the load is between. Camber presses the shoulder also
  // where the crown is clear of the road, so the walk may lead up; where no radius carries as
  // little as the load, the wheel stands at its free radius.
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
  if (f_above > 0.0) above = below = o.R_omega;
  Deflection62 d;
  if (f_below < 0.0) {  // no radius carries it
    d.R_l = 0.0;
  } else {
    for (int i = 0; i < 60 && above - below > 1e-15; ++i) {
      // Illinois: the secant, with the older end halved so that both ends move.
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
  vertical_force_62(tire, o, d.R_l, Fx, Fy, &d.rho);
  return d;
}

double MagicFormula::vertical_force(
    double rho, double omega, double gamma, double p, double Fx, double Fy) const {
  WheelUnderLoad o{};
  const Parameters& q = tire_.p;
  o.omega = omega;
  o.gamma = conventions_.mirrored ? -gamma : gamma;
  o.dpi = (p - q.NOMPRES) / q.NOMPRES;
  const double speed = omega * q.UNLOADED_RADIUS / q.LONGVL;
  o.R_omega = q.UNLOADED_RADIUS * (q.Q_RE0 + q.Q_V1 * speed * speed);  // (1)
  if (rho <= 0.0) return 0.0;
  if (q.version == Version::mf62)
    return vertical_force_62(
        tire_, o, o.R_omega - rho, Fx, conventions_.mirrored ? -Fy : Fy, nullptr);
  const double x = rho / q.UNLOADED_RADIUS;
  return stiffening(tire_, omega, q.Q_FCX * Fx / q.FNOMIN, q.Q_FCY * Fy / q.FNOMIN) *
         (tire_.Q_FZ1 * x + q.Q_FZ2 * x * x) * (1.0 + q.PFZ1 * o.dpi) * q.FNOMIN;
}

}  // namespace latsch::magic_formula
