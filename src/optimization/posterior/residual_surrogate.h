// SPDX-License-Identifier: Apache-2.0
// Models all residuals of a fit far beyond its linear range, from few samples, so that the
// posterior density can be sampled without the model.
//
// The samples y_i lie in whitened coordinates around the fit, y = T^-1 (u - u_fit), where T is the
// Cholesky factor of the covariance of twice the linear deviations (whitened_frame()). In them a
// posterior that is nearly linear is a ball of radius 1/2, and all directions count alike. A
// residual is its linear model plus a random function whose covariance is a polynomial:
//
//   r(y)   = r_c + J y + z(y)
//   k(y,x) = 1000 (1 + g) + g^2/2 + g^3/60 + g^4/1200,    g = y'x                              (1)
//   K_ij   = k(y_i, y_j)                                                                       (2)
//   z(y)   = D' K^-1 k(y),                     d_i = r_i - r_c - J y_i                         (3)
//   v(y)   = k(y,y) - k(y)' K^-1 k(y)                                                          (4)
//
// The ratios of the terms say how large a residual's higher derivatives are beside its curvature.
// Residuals are polynomials of the fourth degree; once there are more samples than coefficients,
// the polynomial is the one nearest to them. If J is exact, residual and slope at the fit are
// known, and the first term of (1) is left out. The variance v is relative: it shows where the
// surrogate knows least, not by how much it errs. How much it errs is measured by trials that it
// has not seen (surrogate_runs.h).
//
// Residuals enter (3) linearly. The factor R of [r_c J D'K^-1] = Q R replaces m residuals by at
// most as many as there are samples, so a sum of squares costs no more for 10,000 residuals than
// for 50. The sum of squares is that of the mean (3), without the variance.
#pragma once

#include <Eigen/Core>

#include "numerics/dense/cholesky.h"

namespace latsch {

constexpr double kInsideCube = 12.0;  // information of a uniform density in the unit cube

/// Coordinates around a fit: u = center + T y, with a lower triangular T.
struct WhitenedFrame {
  Eigen::VectorXd center;  // n, in the unit cube
  Eigen::MatrixXd T;       // n x n, lower triangular

  /// Returns y = T^-1 (u - center).
  Eigen::VectorXd whitened(const Eigen::VectorXd& u) const;
  /// Returns u = center + T y.
  Eigen::VectorXd place(const Eigen::VectorXd& y) const { return center + T * y; }
  /// Returns the distance of u from the center in linear standard deviations, 2 |y|.
  double deviations(const Eigen::VectorXd& u) const { return 2.0 * whitened(u).norm(); }
};

/// Returns the frame whose T T' is four times the covariance (J'J + 12)^-1 of a fit with whitened
/// residuals of deviation 1. The 12 is the information of a variable that is only known to lie
/// inside the unit cube, so that a direction without data gets a finite length.
WhitenedFrame whitened_frame(const Eigen::VectorXd& center, const Eigen::MatrixXd& J);

/// Residuals around a fit.
struct SurrogateSamples {
  Eigen::MatrixXd Y;          // N x n: samples in whitened coordinates
  Eigen::MatrixXd R;          // N x m: residuals of each sample
  Eigen::VectorXd r_c;        // m: residuals at the fit, y = 0
  Eigen::MatrixXd J;          // m x n: slopes dr/dy at the fit
  bool slopes_exact = false;  // true if J was computed by the model, not by differences
};

class ResidualSurrogate {
 public:
  explicit ResidualSurrogate(const SurrogateSamples& samples);

  /// Returns |r(y)|^2 by (3).
  double sum_of_squares(const Eigen::VectorXd& y) const;
  /// Returns the residuals r(y) by (3).
  Eigen::VectorXd residuals(const Eigen::VectorXd& y) const;
  /// Returns the weights w(y) = (1, y, k(y)) and their slopes, one column for each component of y.
  Eigen::VectorXd weights(const Eigen::VectorXd& y) const;
  Eigen::MatrixXd weight_slopes(const Eigen::VectorXd& y) const;
  /// Returns the residuals r(y) by (3) for points y, one in each column; m x points.
  Eigen::MatrixXd residuals_at(const Eigen::MatrixXd& points) const;
  /// Returns R, where R w(y) are residuals with the same sums of squares and products as those of
  /// (3), at most as many as there are weights.
  const Eigen::MatrixXd& reduced() const { return reduced_; }
  /// Returns the relative variance v by (4).
  double variance(const Eigen::VectorXd& y) const;
  /// Returns the covariance of the residuals at these points, one in each row, with (4) on its
  /// diagonal.
  Eigen::MatrixXd covariance(const Eigen::MatrixXd& points) const;

 private:
  double kernel(double g) const;
  double kernel_slope(double g) const;

  Eigen::MatrixXd Y_;
  double slope_prior_;     // 1000, or 0 if the slopes are exact
  Eigen::VectorXd scale_;  // 1 / sqrt(K_ii) of the samples
  numerics::PivotedCholesky factors_;
  Eigen::MatrixXd basis_;    // m x (1 + n + N): r = basis (1, y, k(y))
  Eigen::MatrixXd reduced_;  // R of the factorization of the basis, or the basis if it is smaller
};

}  // namespace latsch
