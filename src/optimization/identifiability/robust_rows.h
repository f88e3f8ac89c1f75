// SPDX-License-Identifier: Apache-2.0
// Residuals of a fit with robust losses, prepared for the covariance of M-estimation.
//
// The fit minimizes S = r'r, where the residuals r and their derivatives J are those after the loss
// (robust_loss.h). With psi and psi' of every residual and X = J / (dr/dx), the derivatives before
// the loss, the gradient of S / 2 is X' psi = J'r, its Hessian is A = X' diag(psi') X, and
//   C = A^-1 X' D R D X A^-1,    D: deviations of psi, R: correlations of neighbors
// is the covariance of the variables [Huber, Robust Statistics, 1981, ch. 7; Hampel et al., Robust
// Statistics, 1986, ch. 6]. Two choices of A and D are needed, because each is wrong for some data:
//   common:  psi' of every value is the mean psi' of its group (the values of one loss and scale),
//            D^2 is the group's sum of psi^2 / (N - n), and C is multiplied by K^2,
//            K = 1 + (n / N) var(psi') / mean(psi')^2, the small-sample factor: for one group this
//            is (6.5) of Huber's section 7.6. This choice is right if each of the values is equally
//            likely to be a wrong one. Its intervals also contain the true value often enough if
//            values are few or if the corner lies below the noise.
//   own:     psi' is that of the value itself. D is the deviation of the values inside the corner,
//            and |psi| itself for a value beyond it. This choice is right if all values but a few
//            are far inside the corner, for example if they are exact and one is wrong; the wrong
//            one may be the only value that determines a variable.
// The covariance is the larger of the two along every direction (`larger`). If psi' is 1 for all
// values, both are those of least squares.
//
// If the noise is stated, the expected psi^2 inside the corner depends on how much the loss limits
// the values: it is that of all noise if no value is limited, and that of Gaussian noise inside the
// corner if the mean psi' is at most the one expected for Gaussian noise; it is interpolated
// between these.
#pragma once

#include <Eigen/Core>
#include <optional>
#include <vector>

#include "optimization/identifiability/residual_noise.h"

namespace latsch {

class RobustRows {
 public:
  /// Prepares m residuals and their m x n derivatives, both after the loss.
  RobustRows(const Eigen::VectorXd& r, const Eigen::MatrixXd& J, const ResidualTraits& traits);

  /// True if some psi' differs from 1. Otherwise psi = r and X = J.
  bool is_limited() const { return is_limited_; }
  /// Returns psi of the m residuals, in the unit of the residuals.
  const Eigen::VectorXd& psi() const { return psi_; }
  /// Returns the derivatives before the loss, m x n. The row of a residual is 0 if the slope dr/dx
  /// of its loss is less than a millionth.
  const Eigen::MatrixXd& X() const { return X_; }
  /// Returns the slope dr/dx of the loss of each of the m residuals.
  const Eigen::VectorXd& slopes() const { return slopes_; }
  /// Returns, for each of the m residuals, the share of a change of it that moves the minimum of S:
  /// psi' / (dr/dx)^2.
  Eigen::VectorXd felt_changes() const;
  /// Returns the number of residuals with a loss, and how many of these lie beyond the corner.
  int with_loss() const { return with_loss_; }
  int beyond() const { return beyond_; }
  /// Returns the expected share of values beyond the corner for Gaussian noise of standard
  /// deviation sigma.
  double expected_beyond(double sigma) const;

  /// These return the weights psi' of A, m: own_weights() that of every value, common_weights() the
  /// mean of its group divided by K.
  const Eigen::VectorXd& own_weights() const { return psi_slopes_; }
  Eigen::VectorXd common_weights() const;

  /// Standard deviations of psi in the two versions of the covariance, m each.
  struct Spreads {
    Eigen::VectorXd common, own;
  };
  /// Returns the deviations of psi, for noise of the stated standard deviation or, if none is
  /// stated, estimated from the residuals but at least `least`.
  Spreads spreads(const std::optional<double>& stated, double least) const;

 private:
  double mean_over(int group, const Eigen::VectorXd& of) const;
  double limited_share(int group, double sigma) const;

  Eigen::MatrixXd X_;
  Eigen::VectorXd psi_, slopes_, psi_slopes_, deviations_;
  std::vector<bool> is_beyond_;
  std::vector<int> groups_;         // one a residual
  std::vector<RobustLoss> losses_;  // loss of each group, for residuals of standard deviation 1
  int with_loss_ = 0, beyond_ = 0;
  bool is_limited_ = false;
};

/// Returns rows H with H'H = J' diag(w) J. If the negative weights w outweigh the positive ones
/// along a direction, H'H is a hundredth of the positive part there.
Eigen::MatrixXd weighted_rows(const Eigen::MatrixXd& J, const Eigen::VectorXd& w);

/// Returns the larger of two positive semidefinite matrices along every direction in a basis in
/// which both are diagonal. `a` must be positive definite.
Eigen::MatrixXd larger(const Eigen::MatrixXd& a, const Eigen::MatrixXd& b);

}  // namespace latsch
