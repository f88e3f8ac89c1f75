// SPDX-License-Identifier: Apache-2.0
// The Magic Formula where a wheel hardly rolls, stands, turns on the spot or turns back: below
// V_low = VXLOW of the file. From there on nothing of this is felt, to the last bit.
//
//   q = (1 - cos(pi |Vx|/V_low))/2                 0 at rest, 1 from V_low on, flat at both
//   V_r = Vx - (1 - q) Vsx                         what brings new tread into the patch: at rest
//                                                  omega R_e, so that a locked wheel rocks on the
//                                                  carcass without creep
//   du/dt + |V_r|/sigma u = -Vsx, |u| <= u_max     at rest u_max = 3 mu Fz/C, three times what
//   dv/dt + |V_r|/sigma v = +Vsy, |v| <= v_max     the friction bends a spring of that stiffness
//   kappa' = (u - k Vsx)/sigma                     k = (1 - q) DAMP_VLOW: damping of the carcass,
//   tan(alpha') = (v + k Vsy)/sigma                which friction limits as well
//   dr/dt + |V_r|/sigma r = V_r/sigma              the way the patch was rolled in: -1 ... 1
//   F = (1 + r')/2 F(+V_low) + (1 - r')/2 F(-V_low) - (1 - r'^2) F(no slip)
//                                                  r' = r + (sgn Vx - r) q
//   dpsi/dt + (|w|/psi_max + |V_r|/a) psi = w      twist of the patch, w: yaw rate of the wheel
//   Mz = ... - (1 - q) C_psi psi                   psi_max = M_inf/C_psi
//
// u, v, their damping and their bound: [Pacejka 2012, 7.2.3]. M_inf is the torque of turning on the
// spot (4.95), C_psi the overall yaw stiffness YAW_STIFFNESS (1 + PCMZ1 dfz): peak and slope of the
// parking torque as in Adams' PAC2002 with turn slip. The law between is that of friction between
// elastic bodies [Dahl 1968]: turned from rest, M = -M_inf (1 - exp(-C_psi psi/M_inf)); let go, a
// part springs back and the rest stays. What ply steer, conicity, trail and camber make without
// slip is there as far as the patch was rolled in, and stays when the wheel stops; own to this
// program, continuous where the formula itself jumps with the sign of Vx.
//
// Limits: the pivoting patch has its friction for itself, sliding takes nothing of it; psi is
// rolled off over half the patch. Mx keeps what the side force without slip adds to it.
// With turn slip (USE_MODE 5) and backward faster than V_low the torque of turning has the sign of
// MF-Tyre's formula, that of rolling forward.
#pragma once

#include <string>
#include <vector>

#include "models/magic_formula/magic_formula.h"

namespace latsch::magic_formula {

/// Of u/sigma and v/sigma while the wheel rolls: far in the sliding region.
constexpr double kMostSlip = 3.0;

/// V_low, m/s: VXLOW; of a file where that is 0 a tenth of what it else is.
double low_speed(const Parameters& parameters);

/// q of a speed in m/s; exactly 1 from `low` on.
double awake(double speed, double low);

/// k in s: what of DAMP_VLOW is left at Vx; of a file where that is 0, of 1 ms.
double standing_damping(double Vx, const Parameters& parameters);

/// u_max/sigma of a patch that moves with `speed` along or over the road, m/s. `peak`: mu Fz;
/// `stiffness`: slope over the slip. Both in N.
double most_slip(double speed, double low, double peak, double stiffness);

/// The formula at any speed. `state`: kappa is u/sigma, positive where the patch is pulled ahead;
/// Vx that of the wheel. `r`: the way the patch was rolled in.
SteadyState at_any_speed(const MagicFormula& formula, State state, double r);

/// What holds a wheel that turns on the spot. Limit 0: nothing does.
struct Pivot {
  double stiffness = 0.0;  // N m/rad, C_psi
  double limit = 0.0;      // N m, M_inf
  double length = 0.0;     // m, a

  /// dpsi/dt with yaw rate w and rolling speed V_r.
  double twist_rate(double psi, double w, double V_r) const;
  /// psi after `step`.
  double twisted(double psi, double w, double V_r, double step) const;

 private:
  double loosening(double w, double V_r) const;  // 1/s
};
/// Under the load and friction of `at`.
Pivot pivot_of(const Parameters& parameters, const SteadyState& at);

/// What is taken where the file has not what a standing wheel needs: one sentence each.
std::vector<std::string> assumed_at_standstill(const Parameters& parameters);

}  // namespace latsch::magic_formula
