// SPDX-License-Identifier: Apache-2.0
// Lost variables: those of which the residuals feel nothing where a search settled, and the places
// where they may be felt again.
//
// A peak outside the data, a decay so fast that nothing of it is left, a stop that is never
// touched: a search can settle without them, and no slope leads back. Often several are lost
// together, center, width and height of one peak, and act only where all of them are right to the
// order of magnitude; moving one is in vain. So they are moved as one, the felt ones left as they
// are, inside bounds and constraints:
//
//   x_i -> s x_i,   s = 1/2, 2, 1/4, 4, ...     by their order of magnitude, toward zero and away
//
// Which are lost is tested, not taken from a model's slopes: these are as wrong as the felt
// variables are curved. With the variables in the order of their slopes, as many of the least ones
// are lost as can be moved together without effect. The least one is tested first: mostly, and
// always under noise, it is felt, and nothing is lost. Then a bisection, log2(n) points. Slopes
// that are wrong put others behind one that is felt: those are tested one by one, up to n - 2
// points.
//
// This relies on a zero that means something: a peak whose place is counted from far away is not
// found, nor anything under noise, where every move is felt. What it brings is judged by
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
  /// `u`: where the search settled; `slopes`: of the residuals along every variable there, norms;
  /// `test`: a move of every variable.
  LostVariables(const DesignSpace& space,
                const FeasibleRegion& region,
                const Eigen::VectorXd& u,
                const Eigen::VectorXd& slopes,
                const Eigen::VectorXd& test);

  /// Whether the next point is to tell which variables are lost.
  bool is_testing() const { return is_bisecting() || tested_alone_ < std::ssize(order_); }
  bool has_next() const { return is_testing() || !places_.empty(); }
  /// In the unit cube. Requires has_next().
  Eigen::VectorXd next() const;
  /// s of the place that is next; 1 for a test.
  double factor() const { return is_testing() ? 1.0 : places_.back().factor; }
  /// Whether residuals at next() differ from those at u, or there was no outcome.
  void observe(bool is_felt);

  /// Indices, as far as they are known.
  const std::vector<int>& lost() const { return lost_; }

 private:
  struct Place {
    Eigen::VectorXd u;
    double factor;
  };

  bool is_bisecting() const { return at_most_ > at_least_; }
  /// Of the order, in the next step of the bisection.
  int bisected() const { return at_least_ == 0 ? 1 : (at_least_ + at_most_ + 1) / 2; }
  void learn(bool is_felt);
  void find_places();

  DesignSpace space_;
  FeasibleRegion region_;
  Eigen::VectorXd u_, test_;
  std::vector<int> order_;          // of the variables, least slope first
  int at_least_ = 0, at_most_ = 0;  // how many of them are lost together
  int tested_alone_ = 0;            // of the order; its length: none any more
  std::vector<int> lost_;
  std::vector<Place> places_;  // the next one last
};

}  // namespace latsch
