// SPDX-License-Identifier: Apache-2.0
// Autoregressive noise, in which each sample depends on those before it.
//
// Model:
//
//   x_j = phi_1 x_{j-1} + ... + phi_p x_{j-p} + e_j         e white, x stationary and of variance 1
//
// The parameters are the partial autocorrelations kappa_1 ... kappa_p. Every choice of them in (-1,
// 1) is stationary. The Levinson-Durbin recursion gives the predictors of all orders k <= p and the
// variances v_k = (1 - kappa_1^2) ... (1 - kappa_k^2) of their errors, hence the exact likelihood
// from the first sample on. [Brockwell, Davis, Time Series: Theory and Methods, 1991, ch. 5.2, 8.7]
//
// R is the correlation matrix of the samples and R = L L' with lower triangular L.
#pragma once

#include <Eigen/Core>
#include <vector>

namespace latsch::numerics {

class Autoregression {
 public:
  /// `partial`: partial autocorrelations; empty: white noise.
  explicit Autoregression(std::vector<double> partial = {});

  int order() const { return static_cast<int>(partial_.size()); }
  const std::vector<double>& partial() const { return partial_; }

  /// Returns L^-1 X, column by column. A column of noise that follows the model becomes white noise
  /// of variance 1.
  Eigen::MatrixXd whitened(const Eigen::MatrixXd& X) const;
  /// Returns L X, which undoes whitened().
  Eigen::MatrixXd unwhitened(const Eigen::MatrixXd& X) const;
  /// Returns L' X. The squared norm of the result for a column x is x' R x.
  Eigen::MatrixXd colored(const Eigen::MatrixXd& X) const;
  /// Returns ln det R for the given number of samples.
  double log_determinant(Eigen::Index samples) const;
  /// Returns 1 + 2 sum of the autocorrelations: the number of samples that determine a mean as well
  /// as one independent sample.
  double samples_for_one() const;

 private:
  std::vector<double> partial_;
  /// Coefficients phi of the predictors of the orders 0 ... p.
  std::vector<std::vector<double>> predictors_;
  std::vector<double> variances_;  // v_0 ... v_p
};

}  // namespace latsch::numerics
