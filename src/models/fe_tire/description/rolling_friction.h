// SPDX-License-Identifier: Apache-2.0
// Friction of a tire's rubber with the ground on which it rolls:
//
//   mu = mu_0 (p/p_0)^(-a) s(|w|),   s = 1 + (mu_m/mu_s - 1) exp(-log^2(|w|/w_m)/c^2)
//
// p is the contact pressure and w the velocity over the ground. mu_0 holds at p_0 and at low speed,
// where s = 1, and again at speeds far above w_m, where s has its peak mu_m/mu_s. [Law after
// Savkoor; docs/fe_tire_motion.md]
//
// A friction that falls with the speed lets the tread slide in jerks where it falls faster than the
// rubber's stiffness holds it, and a steady state does not exist then. no_steeper_than() replaces
// that part of the falling branch by a straight line, which joins s again where s is flatter.
#pragma once

namespace latsch::fe_tire {

/// A law of friction. Speeds are in m/s, pressures in Pa.
struct RollingFriction {
  double at_rest = 1.0;       // mu_0
  double p_0 = 0.0, a = 0.0;  // Pa; exponent of the pressure, 0: none
  double peak = 0.0;          // mu_m/mu_s, 1 or more; 0: no dependence on the sliding speed
  double peak_speed = 1.0;    // m/s, w_m
  double width = 1.0;         // c, natural logarithm of the speed
  /// Speeds between which s is a straight line, m/s, and how much it falls for each m/s; equal
  /// speeds: nowhere.
  double line_from = 0.0, line_to = 0.0, line_fall = 0.0;

  /// Returns mu at the pressure p, Pa, and the sliding speed w, m/s.
  double at(double p, double w) const;
  /// Returns d(mu p)/dp.
  double limit_slope(double p, double w) const;
  /// Returns dmu/dw, s/m.
  double speed_slope(double p, double w) const;
  bool depends_on_speed() const { return peak > 0.0 && peak != 1.0; }
  /// Returns the largest fall of s for each m/s, on the falling branch.
  double steepest_fall() const;
  /// Returns the law whose s falls by `fall` for each m/s at most, s/m.
  RollingFriction no_steeper_than(double fall) const;
  /// Returns by how much the straight line exceeds s at most.
  double most_above() const;

  bool operator==(const RollingFriction&) const = default;

 private:
  double by_speed(double w) const;
};

}  // namespace latsch::fe_tire
