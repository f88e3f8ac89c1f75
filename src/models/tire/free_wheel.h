// SPDX-License-Identifier: Apache-2.0
// A wheel whose spin, or whose axle's height, is not prescribed but follows from the forces on it:
//   m w' = T + F(t, w),  y' = w                   F: an additional moment or force (Push)
//   spin:    y the angle, m the inertia about the spin axis, T the tire's moment My in C
//   height:  y the center's inertial z, m the mass, T the tire's inertial Fz
// It is integrated by the trapezoidal rule, with T of the tire at the end of the step:
//   y1 = y0 + h (w0 + w1)/2,  m a1 = T1 + F(t1, w1),  a1 = 2 (w1 - w0)/h - a0
// Tire::advance_free solves this together with the tire's own step, so the solution is stable at
// any frequency of wheel and belt. It is accurate to order 2 if a period has more than about ten
// steps. Without mass (m = 0) the rule is T1 + F(t1, w1) = 0, and the motion follows from y' = w. A
// brake acts on the spin with dry friction B: -brake if w > 0, +brake if w < 0, and at w = 0 the
// moment that holds the wheel, up to brake.
#pragma once

#include <Eigen/Core>
#include <functional>
#include <optional>

#include "models/tire/tire.h"

namespace latsch {

/// Additional moment or force F, N m or N, and its derivative dF/dw by the rate w, which must not
/// exceed 2 m/h.
struct Push {
  double value = 0.0, by_rate = 0.0;  // F, and dF/dw
};

/// Spin of a wheel, or height of its axle, as a free motion. A step replaces the members by their
/// values at its end.
struct FreeRate {
  double inertia = 0.0;            // m: inertia, kg m^2, or mass, kg
  double place = 0.0, rate = 0.0;  // y, w: angle or height, rad or m, and its rate per s
  double acceleration = 0.0;       // a = w' from all forces, per s^2
  std::function<Push(double time, double rate)> push = {};  // F; none: 0
};

/// The motions of a wheel that follow from the forces on it. A motion that is not set here is
/// prescribed.
struct FreeWheel {
  std::optional<FreeRate> spin = {}, height = {};  // not set: prescribed
  double brake = 0.0;                              // N m, largest moment of the brake on the spin

  /// One number for the spin and one for the height. The number is 0 if that motion is prescribed.
  using Pair = Eigen::Vector2d;
  /// Derivatives of one pair (spin, height) with respect to another.
  using Matrix = Eigen::Matrix2d;

  /// Returns T.
  static Pair forces(const HubForces& hub, const WheelMotion& motion);
  /// Returns an estimate of the rates w1 at the end of the step, extrapolated linearly from the
  /// last step.
  Pair guess(double step) const;
  /// Returns the motion of the wheel at the end of a step if its free motions have these rates
  /// there.
  WheelMotion moved(const WheelMotion& motion, double step, const Pair& rates) const;
  /// Returns the residual of the trapezoidal rule at these rates, T + F + B - m a1, in N m and N.
  /// At w = 0 the brake's moment B is the one that makes the residual smallest.
  Pair left(double time, double step, const Pair& rates, const Pair& T) const;
  /// Returns the rates w1 with zero residual, if the tire's T falls by `stiffness` times the change
  /// of y1 from its value at `rates`. Returns nothing if the solution may not be unique.
  std::optional<Pair> balanced(
      double time, double step, const Pair& rates, const Pair& T, const Matrix& stiffness) const;
  /// Returns the wheel at the end of the step.
  FreeWheel after(double time, double step, const Pair& rates, const Pair& T) const;
};

}  // namespace latsch
