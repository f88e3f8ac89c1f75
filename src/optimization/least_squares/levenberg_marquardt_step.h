// SPDX-License-Identifier: Apache-2.0
// The step of Levenberg's and Marquardt's method from a point u with residuals r and Jacobian J:
//
//   minimize |r + J p|^2   with   |D p| <= Delta   and   u + p in the region
//
// It is the damped step, for some mu >= 0,
//
//   minimize |r + J p|^2 + mu |D p|^2   with   u + p in the region                            (1)
//
// with mu = 0 if that step is short enough, otherwise with the mu that makes |D p| equal to Delta
// within a tenth [Moré, in: Numerical Analysis, Lecture Notes in Mathematics 630, Springer 1978,
// 105]. 1 / |D p| is nearly linear in mu, as Moré notes after Hebden (1973), so a secant inside a
// bracket finds mu in a few solutions of (1). All solutions share the factor R of J. Sums of
// squares are never formed in the unit cube, so steps are exact even if J'J is singular to
// rounding.
//
// Bounds hold variables as step_in_box.h explains. With linear constraints (1) is a quadratic
// program, which uses J'J with its loss of accuracy.
#pragma once

#include <Eigen/Core>
#include <vector>

#include "optimization/problem/feasible_region.h"

namespace latsch {

struct LevenbergMarquardtStep {
  Eigen::VectorXd p;
  double length = 0.0;    // |D p|
  double mu = 0.0;        // damping; 0 for the Gauss-Newton step
  double promised = 0.0;  // |r|^2 - |r + J p|^2
  double slope = 0.0;     // r'J p, half the slope of |r|^2 along p
};

class LevenbergMarquardtSteps {
 public:
  /// Prepares the steps from u, which lies in the region. `D` are scales of the variables, above 0.
  LevenbergMarquardtSteps(const Eigen::VectorXd& r,
                          const Eigen::MatrixXd& J,
                          const Eigen::VectorXd& D,
                          const Eigen::VectorXd& u,
                          const FeasibleRegion& region);

  /// Returns the step for mu = 0, which is the longest one.
  const LevenbergMarquardtStep& full() const { return full_; }
  LevenbergMarquardtStep within(double radius) const;
  /// Returns the damped step (1) for a given mu.
  LevenbergMarquardtStep damped(double mu) const;
  /// Returns an upper limit of the decrease predicted for a step inside the bounds: that of the
  /// step without bounds in the variables that are not held.
  double most_promised() const { return most_promised_; }
  /// Returns a lower limit of the decrease: that predicted for the best move of a single free
  /// variable. If J is nearly singular, joint moves of all variables may predict a decrease that no
  /// real step achieves.
  double promised_by_one() const { return promised_by_one_; }

 private:
  double promised(const Eigen::VectorXd& y) const;
  Eigen::VectorXd solve_free(const Eigen::VectorXd& y,
                             const std::vector<int>& free,
                             double mu) const;
  Eigen::VectorXd damped_in_box(double mu) const;
  Eigen::VectorXd damped_in_polytope(double mu) const;

  bool is_cube_;
  Eigen::VectorXd D_;
  Eigen::MatrixXd R_;              // triangular factor of J D^-1
  Eigen::VectorXd c_;              // Q'r
  Eigen::VectorXd g_;              // D^-1 J'r
  Eigen::VectorXd lower_, upper_;  // bounds of D p that keep u + p in the cube
  std::vector<int> free_;          // variables that are not held at a bound
  Eigen::MatrixXd E_, A_;          // E_ D p = f_,  A_ D p <= b_  in a polytope
  Eigen::VectorXd f_, b_;
  LevenbergMarquardtStep full_;
  double most_promised_ = 0.0, promised_by_one_ = 0.0;
};

}  // namespace latsch
