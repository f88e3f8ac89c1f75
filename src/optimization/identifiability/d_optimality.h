// SPDX-License-Identifier: Apache-2.0
// Which further measurement would tell the most about the variables: D-optimality.
//
// With the information M of the data at hand, a candidate whose residuals have the derivatives J_c
// shrinks the volume of the confidence ellipsoid by  sqrt(det(I + J_c M^-1 J_c')),  whatever it
// will measure [Fedorov, Theory of Optimal Experiments, 1972, ch. 2]. In the unit cube
//   M = J'J / s^2 + 12 I
// where 12 I stands for what the bounds say, the variance 1/12 of a number anywhere between them:
// so a direction that the data leave flat counts as wide as its range, not infinitely wide.
#pragma once

#include <Eigen/Core>
#include <string>
#include <vector>

namespace latsch {

/// A measurement that could be made. Its derivatives are those of the residuals it would add, each
/// divided by its noise.
struct Candidate {
  std::string name;
  Eigen::MatrixXd J;  // rows x variables, of the unit cube
};

struct DOptimality {
  int candidate = 0;       // place in the list
  double shrinkage = 1.0;  // volume of the ellipsoid before over after, >= 1
  double widest_before = 0.0, widest_after = 0.0;  // standard deviation of the widest direction
  Eigen::VectorXd deviations;                      // of every variable, after; in ranges
};

/// Most useful first. `J`: of the data at hand, each row divided by its noise.
std::vector<DOptimality> d_optimality(const Eigen::MatrixXd& J,
                                      const std::vector<Candidate>& candidates);

/// Standard deviation of every variable with the data at hand alone, in ranges.
Eigen::VectorXd deviations_with_bounds(const Eigen::MatrixXd& J);

}  // namespace latsch
