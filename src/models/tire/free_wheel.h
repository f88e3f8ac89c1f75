// SPDX-License-Identifier: Apache-2.0
// A wheel whose spin, or whose axle's height, is not told but follows from what acts on it:
//   m w' = T + F(t, w),  y' = w
//   spin:    y the angle, m the inertia about the spin axis, T the tire's moment My in C
//   height:  y the center's inertial z, m the mass, T the tire's inertial Fz
// by the trapezoidal rule, with T as the tire answers to where the step ends:
//   y1 = y0 + h (w0 + w1)/2,  m a1 = T1 + F(t1, w1),  a1 = 2 (w1 - w0)/h - a0
// Tire::advance_free solves this together with the tire's own step, so that nothing grows however
// fast wheel and belt ring against each other; of order 2, which is felt where a period has more
// than some ten steps. Without mass (m = 0) the rule is T1 + F(t1, w1) = 0: y' = w is what lags.
// To the spin comes a brake, dry friction B: -brake where w > 0, +brake where w < 0, at w = 0 what
// holds the wheel, up to brake.
#pragma once

#include <Eigen/Core>
#include <functional>
#include <optional>

#include "models/tire/tire.h"

namespace latsch {

/// F, N m or N, and dF/dw, which must not be above 0 by more than 2 m/h.
struct Push {
  double value = 0.0, by_rate = 0.0;
};

/// One of the two: a value, which a step replaces by that at its end.
struct FreeRate {
  double inertia = 0.0;                                     // m: kg m^2; kg
  double place = 0.0, rate = 0.0;                           // y, w: rad, m; per s
  double acceleration = 0.0;                                // a: w', by all that acts; per s^2
  std::function<Push(double time, double rate)> push = {};  // F; none: 0
};

/// What is not here is told by the wheel's motion.
struct FreeWheel {
  std::optional<FreeRate> spin = {}, height = {};
  double brake = 0.0;  // N m, on the spin

  /// Of the spin, of the height; 0 of what is not free.
  using Pair = Eigen::Vector2d;
  using Matrix = Eigen::Matrix2d;

  /// T.
  static Pair forces(const HubForces& hub, const WheelMotion& motion);
  /// w1 straight on from the last step.
  Pair guess(double step) const;
  /// The motion with what is free as it is where a step ends at these rates.
  WheelMotion moved(const WheelMotion& motion, double step, const Pair& rates) const;
  /// What the rule leaves at these rates, T + F + B - m a1, N m and N; of B at w = 0 what leaves
  /// least.
  Pair left(double time, double step, const Pair& rates, const Pair& T) const;
  /// w1 that leave nothing where T falls by `stiffness` with y1 from T at `rates`. Nothing where no
  /// rates are sure to be the only ones.
  std::optional<Pair> balanced(
      double time, double step, const Pair& rates, const Pair& T, const Matrix& stiffness) const;
  /// The end of the step.
  FreeWheel after(double time, double step, const Pair& rates, const Pair& T) const;
};

}  // namespace latsch
