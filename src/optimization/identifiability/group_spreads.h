// SPDX-License-Identifier: Apache-2.0
// Spreads of groups of residuals that are estimated from the residuals of a fit, one for each
// group, and how uncertain they are.
//
// Residuals x = r / deviation of group g have the variance theta_g, and G spans the changes that
// variables and solved unknowns cause. The restricted likelihood [Patterson, Thompson, Biometrika
// 58 (1971) 545] is largest for
//   theta_g = |x~_g|^2 / (n_g - sum of the leverages of g),     x~ = theta P x,
//   P = V^-1 - V^-1 G (G' V^-1 G)^-1 G' V^-1,                    V = diag(theta)
// which is solved by iteration. The inverse of the information, 2 / tr(P V_a P V_b) for ln theta,
// is the covariance W of the ln theta. Few values leave W large, and intervals need it twice
// [Kenward, Roger, Biometrics 53 (1997) 983]: an estimated variance c = sum of c_g has the degrees
// of freedom 2 c^2 / sum of W_ab c_a c_b, and weights that follow from the estimates add
// 2 sum of W_ab (V F_a)' P (V F_b) to the covariance of F' x, of which one half is the spread that
// wrong weights cause and the other half the bias of the plain covariance.
//
// Limits: a spread is never taken for less than the root mean square of the group's residuals at
// the fit, because a likelihood that gives a group ever more weight has no bound. A group of one or
// two values that may follow the fit almost exactly has hardly any degree of freedom left; then
// intervals contain the truth less often than they say, and the noise should be stated.
#pragma once

#include <Eigen/Core>
#include <map>
#include <vector>

namespace latsch {

class GroupSpreads {
 public:
  GroupSpreads() = default;
  /// Estimates the spreads from residuals x in units of their deviations and the columns of G.
  /// `groups` holds the group of every residual; < 0: its deviation is known.
  GroupSpreads(const Eigen::VectorXd& x, const Eigen::MatrixXd& G, const std::vector<int>& groups);

  /// True if there are no groups, so that all residuals share one spread.
  bool empty() const { return rows_.empty(); }
  /// Returns the estimated spread for every residual, 1 if its deviation is known.
  const Eigen::VectorXd& of_residuals() const { return spreads_; }
  /// Returns for every group, by its number, how many values are left beside those that the fit
  /// uses up: n_g less the leverages of the group.
  const std::map<int, double>& freedoms() const { return freedoms_; }

  /// Returns what the uncertain weights add to the covariance Z' Z, for columns Z in units of the
  /// residuals' spreads.
  Eigen::MatrixXd more_covariance(const Eigen::MatrixXd& Z) const;
  /// Returns the relative variance of the estimated variance |z|^2.
  double relative_variance(const Eigen::VectorXd& z) const;

 private:
  std::vector<std::vector<Eigen::Index>> rows_;  // rows of every group
  std::map<int, double> freedoms_;
  Eigen::VectorXd spreads_;
  Eigen::MatrixXd Q_;  // orthonormal columns that span V^-1/2 G
  Eigen::MatrixXd W_;  // covariance of the logarithms of the variances
};

/// True if there are at least two groups of residuals whose spreads are estimated.
bool has_several_groups(const std::vector<int>& groups);

}  // namespace latsch
