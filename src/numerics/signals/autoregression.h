// SPDX-License-Identifier: Apache-2.0
// Autoregressive noise: samples of which each depends on those before it.
//
//   x_j = phi_1 x_{j-1} + ... + phi_p x_{j-p} + e_j         e white, x stationary and of variance 1
//
// Written in partial autocorrelations kappa_1 ... kappa_p, each in (-1, 1), of which every choice
// is stationary; Levinson and Durbin's recursion gives the predictors of all orders k <= p and the
// variances v_k = (1 - kappa_1^2) ... (1 - kappa_k^2) of their errors, hence the exact likelihood
// from the first sample on. [Brockwell, Davis, Time Series: Theory and Methods, 1991, ch. 5.2, 8.7]
//
// With R the correlation matrix of as many samples and R = L L', L lower triangular.
#pragma once

#include <Eigen/Core>
#include <vector>

namespace latsch::numerics {

class Autoregression {
 public:
  /// None: white.
  explicit Autoregression(std::vector<double> partial = {});

  int order() const { return static_cast<int>(partial_.size()); }
  const std::vector<double>& partial() const { return partial_; }

  /// L^-1 X, column by column: of a column that is such noise, white noise of variance 1.
  Eigen::MatrixXd whitened(const Eigen::MatrixXd& X) const;
  /// L' X: the squared norm of a column x is x' R x.
  Eigen::MatrixXd colored(const Eigen::MatrixXd& X) const;
  /// ln det R of so many samples.
  double log_determinant(Eigen::Index samples) const;
  /// 1 + 2 sum of the autocorrelations: so many samples tell as much of a mean as an independent
  /// one.
  double samples_for_one() const;

 private:
  std::vector<double> partial_;
  std::vector<std::vector<double>> predictors_;  // phi of every order 0 ... p
  std::vector<double> variances_;                // v_0 ... v_p
};

}  // namespace latsch::numerics
