// SPDX-License-Identifier: Apache-2.0
// The Magic Formula for a wheel that hardly rolls, stands, turns on the spot or reverses: below
// V_low = VXLOW of the file. At and above V_low these equations change nothing, to the last bit.
//
//   q = (1 - cos(pi |Vx|/V_low))/2                 0 at rest, 1 from V_low on, with zero slope at
//                                                  both ends
//   V_r = Vx - (1 - q) Vsx                         the speed at which tread enters the patch: at
//                                                  rest omega R_e, so that a locked wheel rocks on
//                                                  the carcass without creep
//   du/dt + |V_r|/sigma u = -Vsx, |u| <= u_max     at rest u_max = 3 mu Fz/C, three times the
//   dv/dt + |V_r|/sigma v = +Vsy, |v| <= v_max     deflection of a spring of that stiffness by the
//                                                  friction
//   kappa' = (u - k Vsx)/sigma                     k = (1 - q) DAMP_VLOW: damping of the carcass,
//   tan(alpha') = (v + k Vsy)/sigma                which friction limits as well
//   dr/dt + |V_r|/sigma r = V_r/sigma              the direction in which the patch was rolled in,
//                                                  -1 ... 1
//   F = (1 + r')/2 F(+V_low) + (1 - r')/2 F(-V_low) - (1 - r'^2) F(no slip)
//                                                  r' = r + (sgn Vx - r) q
//   dpsi/dt + (|w|/psi_max + |V_r|/a) psi = w      twist of the patch, w: yaw rate of the wheel
//   Mz = ... - (1 - q) C_psi psi                   psi_max = M_inf/C_psi
//
// u, v, their damping and their bound: [Pacejka 2012, 7.2.3]. M_inf is the torque of turning on the
// spot (4.95), C_psi the overall yaw stiffness YAW_STIFFNESS (1 + PCMZ1 dfz): they are peak and
// initial slope of the parking torque, as in Adams' PAC2002 with turn slip. Between them the torque
// obeys the law of friction between elastic bodies [Dahl 1968]: a wheel turned from rest has the
// torque M = -M_inf (1 - exp(-C_psi psi/M_inf)); after release a part of the angle springs back and
// the rest remains. Forces and moments by ply steer, conicity, trail and camber without slip appear
// in proportion to r and remain when the wheel stops. This rule is specific to this program; it is
// continuous, while the formula itself jumps with the sign of Vx.
//
// Limits: the friction torque of the pivoting patch is independent of sliding, which does not
// reduce it. Rolling removes psi over half the length of the patch. Mx keeps the contribution of
// the side force without slip. With turn slip (USE_MODE 5) and backward motion faster than V_low,
// the torque of turning has the sign of MF-Tyre's formula, which is that of rolling forward.
#pragma once

#include <string>
#include <vector>

#include "models/magic_formula/magic_formula.h"

namespace latsch::magic_formula {

/// Largest u/sigma and v/sigma while the wheel rolls. At this slip the patch slides completely.
constexpr double kMostSlip = 3.0;

/// Returns V_low, m/s: VXLOW of the file, or 0.1 m/s if it is 0.
double low_speed(const Parameters& parameters);

/// Returns q for a speed in m/s. It is exactly 1 from the speed `low` on.
double awake(double speed, double low);

/// Returns the damping k, s: the share of DAMP_VLOW that acts at the speed Vx. If DAMP_VLOW of the
/// file is 0, it is taken as 1 ms.
double standing_damping(double Vx, const Parameters& parameters);

/// Returns u_max/sigma of a contact patch that rolls or slides at `speed`, m/s. `peak` is mu Fz, N,
/// and `stiffness` the derivative of the force by slip, N.
double most_slip(double speed, double low, double peak, double stiffness);

/// Evaluates the formula at any speed. In `state`, kappa is u/sigma, which is positive if the patch
/// is pulled forward, and Vx is the velocity of the wheel. `r` is the direction in which the patch
/// was rolled in, -1 to 1.
SteadyState at_any_speed(const MagicFormula& formula, State state, double r);

/// Moment that resists the turning of a wheel on the spot. If the limit is 0, there is no such
/// moment.
struct Pivot {
  double stiffness = 0.0;  // N m/rad, C_psi
  double limit = 0.0;      // N m, M_inf
  double length = 0.0;     // m, a

  /// Returns dpsi/dt, rad/s, at the yaw rate w and the rolling speed V_r.
  double twist_rate(double psi, double w, double V_r) const;
  /// Returns the twist psi after `step` seconds.
  double twisted(double psi, double w, double V_r, double step) const;

 private:
  double loosening(double w, double V_r) const;  // 1/s
};
/// Returns the resistance to turning for the load and friction of the results `at`.
Pivot pivot_of(const Parameters& parameters, const SteadyState& at);

/// Returns sentences that say which torsional stiffness is assumed for a wheel that turns on the
/// spot.
std::vector<std::string> assumed_of_turning(const Parameters& parameters);

/// Returns one sentence per assumption that is made because the file lacks data for a wheel slower
/// than VXLOW. For a wheel that turns on the spot, assumed_of_turning() returns further
/// assumptions.
std::vector<std::string> assumed_at_standstill(const Parameters& parameters);

}  // namespace latsch::magic_formula
