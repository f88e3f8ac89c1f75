// SPDX-License-Identifier: Apache-2.0
// Interpolates several fields that vary smoothly over a few settings, from scattered samples:
// kriging with one covariance for all fields [Sacks, Welch, Mitchell, Wynn, Statist. Sci. 4 (1989)
// 409].
//
//   y(s) = b' f(s) + z(s),   cov(z(s), z(t)) = product over i of exp(-(s_i - t_i)^2 / (2 l_i^2))
//
// with f = (1, s_1, ..). The lengths l_i are those with the least error of samples that are left
// out in turn; of each field,
//   e_k = (K^-1 (y - F b))_k / (K^-1)_kk,      Q^2 = 1 - sum e^2 / sum (y - mean)^2
// [Dubrule, Math. Geol. 15 (1983) 687]. Q^2 is 1 for an exact interpolation and 0 for one no
// better than the mean. The lengths have seen the samples, so Q^2 flatters a little.
//
// Limits: kinks and leaps are smeared; Q^2 shows it.
#pragma once

#include <Eigen/Core>

namespace latsch {

class FieldKriging {
 public:
  /// Takes samples at places (N x d, unit cube) of fields (N x q). Requires N >= d + 2.
  FieldKriging(const Eigen::MatrixXd& places, const Eigen::MatrixXd& fields);

  /// Returns the q fields at a place (d).
  Eigen::VectorXd at(const Eigen::VectorXd& place) const;
  /// Q^2 of each field; 1 for a constant one.
  const Eigen::VectorXd& Q2() const { return Q2_; }

 private:
  Eigen::MatrixXd places_;
  Eigen::VectorXd lengths_;
  Eigen::MatrixXd trend_;    // (1 + d) x q
  Eigen::MatrixXd weights_;  // N x q
  Eigen::VectorXd Q2_;
};

}  // namespace latsch
