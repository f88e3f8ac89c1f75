// SPDX-License-Identifier: Apache-2.0
// A wheel whose spin, or whose axle's height, is not prescribed but follows from the forces on it:
//   m w' = T + F(t, w),  y' = w
//   spin:    y the angle, m the inertia about the spin axis, T the tire's moment My in C
//   height:  y the center's inertial z, m the mass, T the tire's inertial Fz
// It is integrated by the trapezoidal rule, with T of the tire at the end of the step:
//   y1 = y0 + h (w0 + w1)/2,  m a1 = T1 + F(t1, w1),  a1 = 2 (w1 - w0)/h - a0
// Tire::advance_free solves this together with the tire's own step, so the solution is stable
// however fast wheel and belt vibrate against each other. The order is 2, which is visible if a
// period has more than about ten steps. Without mass (m = 0) the rule is T1 + F(t1, w1) = 0, and y'
// = w provides the lag. A brake acts on the spin with dry friction B: -brake if w > 0, +brake if w
// < 0, and at w = 0 the moment that holds the wheel, up to brake.
#pragma once

#include <Eigen/Core>
#include <functional>
#include <optional>

#include "models/tire/tire.h"

namespace latsch {

/// F, N m or N, and dF/dw, which must not exceed 2 m/h.
struct Push {
  double value = 0.0, by_rate = 0.0;  // F, and dF/dw
};

/// Spin or height. A step replaces it by its value at the end.
struct FreeRate {
  double inertia = 0.0;                                     // m: kg m^2; kg
  double place = 0.0, rate = 0.0;                           // y, w: rad, m; per s
  double acceleration = 0.0;                                // a: w', from all forces; per s^2
  std::function<Push(double time, double rate)> push = {};  // F; none: 0
};

/// The free rates of a wheel. A rate that is not given here is prescribed by the wheel's motion.
struct FreeWheel {
  std::optional<FreeRate> spin = {}, height = {};  // none: prescribed
  double brake = 0.0;                              // N m, on the spin

  /// A number for the spin and one for the height; 0 for what is not free.
  using Pair = Eigen::Vector2d;
  /// Derivatives of a pair with respect to another.
  using Matrix = Eigen::Matrix2d;

  /// Returns T.
  static Pair forces(const HubForces& hub, const WheelMotion& motion);
  /// Extrapolates w1 linearly from the last step.
  Pair guess(double step) const;
  /// Returns the motion at the end of a step with these free rates.
  WheelMotion moved(const WheelMotion& motion, double step, const Pair& rates) const;
  /// Returns the residual of the rule at these rates, T + F + B - m a1, N m and N. At w = 0 the B
  /// with the smallest residual is used.
  Pair left(double time, double step, const Pair& rates, const Pair& T) const;
  /// Returns the w1 with zero residual if T falls by `stiffness` times y1 from its value at
  /// `rates`. Returns nothing if the solution may not be unique.
  std::optional<Pair> balanced(
      double time, double step, const Pair& rates, const Pair& T, const Matrix& stiffness) const;
  /// Returns the wheel at the end of the step.
  FreeWheel after(double time, double step, const Pair& rates, const Pair& T) const;
};

}  // namespace latsch
