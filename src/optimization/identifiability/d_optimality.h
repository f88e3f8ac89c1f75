// SPDX-License-Identifier: Apache-2.0
// D-optimality ranks further measurements by how much they would determine the variables.
//
// M is the information of the present data. A candidate whose residuals have the derivatives J_c
// shrinks the volume of the confidence ellipsoid by  sqrt(det(I + J_c M^-1 J_c')),  whatever values
// it will measure [Fedorov, Theory of Optimal Experiments, 1972, ch. 2]. In the unit cube
//   M = J'J / s^2 + 12 I
// The term 12 I is the information of the bounds, the inverse of the variance 1/12 of a number
// anywhere between them. So a direction that the data do not determine counts as wide as its range,
// not infinitely wide.
#pragma once

#include <Eigen/Core>
#include <string>
#include <vector>

namespace latsch {

/// A measurement that could be made. Its derivatives are those of the residuals it would add, each
/// divided by its noise.
struct Candidate {
  std::string name;   // for people
  Eigen::MatrixXd J;  // one row for each residual, one column for each variable of the unit cube
};

struct DOptimality {
  int candidate = 0;  // index of the candidate in the list
  /// Volume of the ellipsoid before the measurement divided by that after it, >= 1.
  double shrinkage = 1.0;
  double widest_before = 0.0, widest_after = 0.0;  // standard deviation of the widest direction
  /// Standard deviation of each variable after the measurement, as a share of its range.
  Eigen::VectorXd deviations;
};

/// Returns the candidates, the most useful first. `J` belongs to the present data; each row is
/// divided by its noise.
std::vector<DOptimality> d_optimality(const Eigen::MatrixXd& J,
                                      const std::vector<Candidate>& candidates);

/// Returns the standard deviation of every variable from the present data and the bounds, in
/// ranges.
Eigen::VectorXd deviations_with_bounds(const Eigen::MatrixXd& J);

}  // namespace latsch
