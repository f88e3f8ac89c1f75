// SPDX-License-Identifier: Apache-2.0
// Lost variables have no effect on the residuals at the point where a search settled. This class
// finds them and the points at which they may have an effect again.
//
// Examples are a peak outside the data, a decay so fast that nothing of it is left, a stop that is
// never touched: a search can settle at a point where such variables have no effect, and no slope
// leads back. Often several are lost together, for example center, width and height of one peak.
// They then have an effect only if all of them have the right order of magnitude, so that moving
// one alone changes nothing. So they are moved together, with the other variables fixed, inside
// bounds and constraints:
//
//   x_i -> s x_i,   s = 1/2, 2, 1/4, 4, ...     by factors, toward zero and away from it
//
// Lost variables are found by tests, not from a model's slopes, because the slopes are wrong if
// other variables act nonlinearly. The variables are ordered by their slopes, least first; the lost
// ones are as many from the front as can be moved together without effect. The first variable is
// tested first. Usually, and always if residuals are noisy, it has an effect, and no variable is
// lost. Otherwise a bisection of log2(n) points follows. Wrong slopes can place lost variables
// after one with an effect in this order; these are tested one by one, with up to n - 2 points.
//
// The method assumes that zero is a meaningful value of a variable: a peak whose position is
// counted from a distant origin is not found. If residuals are noisy nothing is found, because
// every move has an effect. Its benefit is judged by
// verification/identification_set/lost_problems.cpp (./bench.sh lost_variables).
#pragma once

#include <Eigen/Core>
#include <iterator>
#include <vector>

#include "optimization/problem/design_space.h"
#include "optimization/problem/feasible_region.h"

namespace latsch {

class LostVariables {
 public:
  /// `u` is the point where the search settled, `slopes` holds the norm of the residuals' slope
  /// along every variable there, and `test` a test move of every variable.
  LostVariables(const DesignSpace& space,
                const FeasibleRegion& region,
                const Eigen::VectorXd& u,
                const Eigen::VectorXd& slopes,
                const Eigen::VectorXd& test);

  /// True if the next point tests which variables are lost.
  bool is_testing() const { return is_bisecting() || tested_alone_ < std::ssize(order_); }
  bool has_next() const { return is_testing() || !places_.empty(); }
  /// Returns the next point to evaluate, in the unit cube. Requires has_next().
  Eigen::VectorXd next() const;
  /// Returns the factor s of the next point; 1 for a test.
  double factor() const { return is_testing() ? 1.0 : places_.back().factor; }
  /// `is_felt` is true if residuals at next() differ from those at u, or if there was no outcome.
  void observe(bool is_felt);

  /// Returns the indices of the lost variables found so far.
  const std::vector<int>& lost() const { return lost_; }

 private:
  struct Place {
    Eigen::VectorXd u;
    double factor;
  };

  bool is_bisecting() const { return at_most_ > at_least_; }
  /// Number of variables, from the front of the order, that the next step of the bisection moves.
  int bisected() const { return at_least_ == 0 ? 1 : (at_least_ + at_most_ + 1) / 2; }
  void learn(bool is_felt);
  void find_places();

  DesignSpace space_;
  FeasibleRegion region_;
  Eigen::VectorXd u_, test_;
  std::vector<int> order_;          // indices of the variables, those with the least slope first
  int at_least_ = 0, at_most_ = 0;  // bounds on the number of lost variables
  /// Index in order_ of the variable tested alone; its length if no test is left.
  int tested_alone_ = 0;
  std::vector<int> lost_;
  std::vector<Place> places_;  // points to be tried, the next one last
};

}  // namespace latsch
