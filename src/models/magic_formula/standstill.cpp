// SPDX-License-Identifier: Apache-2.0
#include "models/magic_formula/standstill.h"

#include <array>
#include <bit>
#include <cmath>
#include <numbers>

#include "models/magic_formula/transient_slip.h"
#include "models/magic_formula/wheel_contact.h"

namespace latsch::magic_formula {
namespace {

constexpr double kLowSpeed = 0.1;   // m/s, used if VXLOW of the file is 0
constexpr double kDampVlow = 1e-3;  // s, default of DAMP_VLOW, from the sample file of MF-Swift
// Default of M_inf/C_psi, rad, from the sample file of MF-Swift: 4795 N m/rad and about 240 N m.
constexpr double kPivotAngle = 0.05;
constexpr double kShortestPatch = 0.01;  // m

using Fields = std::array<double, sizeof(SteadyState) / sizeof(double)>;

SteadyState mixed(const SteadyState& a, const SteadyState& b, double share_of_b) {
  Fields x = std::bit_cast<Fields>(a);
  const Fields y = std::bit_cast<Fields>(b);
  for (std::size_t i = 0; i < x.size(); ++i) x[i] += share_of_b * (y[i] - x[i]);
  return std::bit_cast<SteadyState>(x);
}

/// Evaluates the formula for a contact patch that was rolled in with the direction `r`. The rolling
/// resistance is that of a tire that rolls at V_low.
SteadyState at_low_speed(const MagicFormula& formula, State state, double low, double r) {
  state.Vx = low;
  const SteadyState ahead = formula.evaluate(state);
  if (r == 1.0) return ahead;
  state.Vx = -low;
  state.kappa = -state.kappa;  // sign of the formula's kappa = (omega R_e - Vx)/Vx
  SteadyState back = formula.evaluate(state);
  back.My = -back.My;
  return mixed(back, ahead, 0.5 * (1.0 + r));
}

}  // namespace

double low_speed(const Parameters& p) { return p.VXLOW > 0.0 ? p.VXLOW : kLowSpeed; }

double awake(double speed, double low) {
  const double share = std::abs(speed) / low;
  return share < 1.0 ? 0.5 * (1.0 - std::cos(std::numbers::pi * share)) : 1.0;
}

double standing_damping(double Vx, const Parameters& p) {
  return (1.0 - awake(Vx, low_speed(p))) * (p.DAMP_VLOW > 0.0 ? p.DAMP_VLOW : kDampVlow);
}

double most_slip(double speed, double low, double peak, double stiffness) {
  const double q = awake(speed, low), K = std::abs(stiffness);
  if (q == 1.0 || !(K > 0.0)) return kMostSlip;
  const double resting = std::min(3.0 * peak / K, kMostSlip);
  return resting + q * (kMostSlip - resting);
}

SteadyState at_any_speed(const MagicFormula& formula, State state, double r) {
  const double Vx = state.Vx, low = low_speed(formula.parameters());
  if (std::abs(Vx) >= low) {
    state.kappa = std::copysign(1.0, Vx) * state.kappa;
    return formula.evaluate(state);
  }
  const double felt = r + (std::copysign(1.0, Vx) - r) * awake(Vx, low);
  SteadyState s = at_low_speed(formula, state, low, felt);
  s.My *= Vx / low;
  const double absent = 1.0 - felt * felt;
  if (absent == 0.0) return s;
  state.kappa = state.alpha = 0.0;
  const SteadyState still = at_low_speed(formula, state, low, felt);
  s.Fx -= absent * still.Fx;
  s.Fy -= absent * still.Fy;
  s.Mz -= absent * still.Mz;
  return s;
}

double Pivot::loosening(double w, double V_r) const {
  return std::abs(w) * stiffness / limit + std::abs(V_r) / length;
}

double Pivot::twist_rate(double psi, double w, double V_r) const {
  return limit > 0.0 ? w - loosening(w, V_r) * psi : 0.0;
}

double Pivot::twisted(double psi, double w, double V_r, double step) const {
  if (!(limit > 0.0)) return 0.0;
  return relaxed(psi, w, loosening(w, V_r), limit / stiffness, step);
}

Pivot pivot_of(const Parameters& p, const SteadyState& at) {
  const double Fz0 = p.LFZO * p.FNOMIN, mu = std::abs(at.muy);
  // Friction torque of a round contact patch of radius R under uniform pressure: 2/3 mu Fz R.
  const double rubbing =
      2.0 / 3.0 * mu * at.Fz * std::sqrt(4.0 * std::max(at.a * at.b, 0.0) / std::numbers::pi);
  Pivot pivot;
  pivot.limit = p.QCRP1 > 0.0 ? p.QCRP1 * mu * p.UNLOADED_RADIUS * at.Fz * std::sqrt(at.Fz / Fz0) *
                                    p.LMP  // (4.95)
                              : rubbing;
  pivot.stiffness = p.YAW_STIFFNESS * (1.0 + p.PCMZ1 * (at.Fz - Fz0) / Fz0);
  if (!(pivot.stiffness > 0.0)) pivot.stiffness = pivot.limit / kPivotAngle;
  pivot.length = std::max(at.a, kShortestPatch);
  return pivot;
}

std::vector<std::string> assumed_of_turning(const Parameters& p) {
  std::vector<std::string> assumed;
  if (!(p.YAW_STIFFNESS > 0.0))
    assumed.emplace_back(
        "assumed, because there is no YAW_STIFFNESS: the torque that turns the wheel on the spot "
        "over 0.05 rad");
  if (!(p.QCRP1 > 0.0))
    assumed.emplace_back(
        "there is no QCRP1: that torque is taken as the friction of a round patch");
  return assumed;
}

std::vector<std::string> assumed_at_standstill(const Parameters& p) {
  std::vector<std::string> assumed;
  if (!(p.VXLOW > 0.0)) assumed.emplace_back("VXLOW is 0: a wheel stands below 0.1 m/s");
  if (!(p.DAMP_VLOW > 0.0))
    assumed.emplace_back(
        "DAMP_VLOW is 0 or missing: the carcass of a standing wheel is damped by 1 ms");
  return assumed;
}

}  // namespace latsch::magic_formula
