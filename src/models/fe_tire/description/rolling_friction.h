// SPDX-License-Identifier: Apache-2.0
// Friction of a tire's rubber with the ground on which it rolls.
#pragma once

namespace latsch::fe_tire {

/// Coefficient of friction mu = mu_0 (p/p_0)^(-a) [mu_s + (mu_m - mu_s) exp(-log^2(|w|/w_m)/c^2)]/
/// mu_s, where mu_0 holds at p_0 and at low speed.
struct RollingFriction {
  double at_rest = 1.0;       // mu_0
  double p_0 = 0.0, a = 0.0;  // Pa; exponent of the pressure, 0: none
  double peak = 0.0;          // mu_m/mu_s; 0: no dependence on the sliding speed
  double peak_speed = 1.0;    // m/s, w_m
  double width = 1.0;         // c, natural logarithm of the speed
  /// Returns mu at the pressure p, Pa, and the sliding speed w, m/s.
  double at(double p, double w) const;
  /// Returns d(mu p)/dp.
  double limit_slope(double p, double w) const;
};

}  // namespace latsch::fe_tire
