// SPDX-License-Identifier: Apache-2.0
// One step of time of a body in motion by the method of Wood, Bossak and Zienkiewicz, with
// Newmark's rules:
//
//   x' = x + h v + h^2 [(1/2 - beta) a + beta a'],   v' = v + h [(1 - gamma) a + gamma a'],
//   M [(1 - alpha) a' + alpha a] + f(x', v', t') = 0                                          (V.4)
//   alpha = (rho - 1)/(rho + 1), gamma = 1/2 - alpha, beta = (1 - alpha)^2/4
//
// rho is the share of a vibration of high frequency that is left after each step, 0 to 1. The
// method is of second order and stable for any step if f is linear. All forces belong to the end of
// the step, as friction (F.5) and unilateral contact need it; in the generalized alpha method,
// which averages them over the step, the load would lag by a part of it.
//   [Wood, Bossak & Zienkiewicz, Int. J. Numer. Meth. Eng. 15 (1980) 1562-1566; Chung & Hulbert, J.
//   Appl. Mech. 60 (1993) 371-375]
#pragma once

#include <Eigen/Core>

namespace latsch::fe_tire {

struct BossakStep {
  double h;  // s
  double alpha, beta, gamma;

  BossakStep(double step, double rho)
      : h(step),
        alpha((rho - 1.0) / (rho + 1.0)),
        beta(0.25 * (1.0 - alpha) * (1.0 - alpha)),
        gamma(0.5 - alpha) {}

  /// A motion of the unknowns.
  struct Motion {
    Eigen::VectorXd x, v, a;
  };
  /// Returns the motion at the end of the step if the unknowns are then x.
  Motion at(const Motion& before, const Eigen::VectorXd& x) const {
    Motion now{x, {}, (x - reached(before)) / (beta * h * h)};
    now.v = before.v + h * ((1.0 - gamma) * before.a + gamma * now.a);
    return now;
  }
  /// Returns x at the end of the step if the acceleration stays what it is.
  Eigen::VectorXd predicted(const Motion& before) const {
    return reached(before) + beta * h * h * before.a;
  }
  /// Returns the acceleration by which the mass is multiplied in (V.4).
  Eigen::VectorXd mean_acceleration(const Motion& before, const Motion& now) const {
    return (1.0 - alpha) * now.a + alpha * before.a;
  }
  /// Return the factors of the mass and of the damping in the derivative of (V.4) by x.
  double of_mass() const { return (1.0 - alpha) / (beta * h * h); }
  double of_damping() const { return gamma / (beta * h); }

 private:
  Eigen::VectorXd reached(const Motion& before) const {
    return before.x + h * before.v + (0.5 - beta) * h * h * before.a;
  }
};

}  // namespace latsch::fe_tire
