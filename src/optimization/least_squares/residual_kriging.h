// SPDX-License-Identifier: Apache-2.0
// Kriging of residuals: quadratic models of all residuals around a point, from any number of
// samples.
//
//   r_hat(z) = r_c + J z + 1/2 z' H z      for every residual; z = (u - center) / h
//
// J and H are the most likely ones under these assumptions: before anything is known, slopes have
// the variance V_g and curvatures the variance 1 (2 on the diagonal of H). A sample at z deviates
// from every quadratic with the variance rho |z|^6, as of cubic terms, plus that of noise. This is
// kriging, interpolation by a Gaussian process [Sacks, Welch, Mitchell, Wynn, Statist. Sci. 4
// (1989) 409], with the kernel
//
//   k(z, w) = V_g z'w + 1/2 (z'w)^2 + noise                                                   (1)
//   (K + diag(rho |z_i|^6 + noise)) alpha = d,      d_i = r(z_i) - r_c                        (2)
//   r_hat(z) = r_c + sum_i alpha_i k(z_i, z)                                                  (3)
//
// (the noise in k is that of r_c, which all d_i share). As V_g >> 1, samples are explained by
// slopes if slopes suffice, and otherwise by the least curvature. The limit of large V_g and small
// rho is the minimum-Frobenius-norm model [Conn, Scheinberg, Vicente, Introduction to
// Derivative-Free Optimization, SIAM 2009, ch. 5], which POUNDERS applies to residuals [Wild, in:
// Advances and Trends in Optimization, SIAM 2017, ch. 40]. Samples count less the farther they are.
// If the Jacobian at the center is known, it replaces V_g.
//
// The variance of the model, with the amplitude s^2 that makes the samples likeliest, is
//
//   v(z) = s^2 (k(z, z) - k(z)' K^-1 k(z) + rho |z|^6),                                       (4)
//   s^2 = sum over residuals d' K^-1 d / N
//
// (K with its diagonal of (2), k without noise), so |r_hat(z)|^2 + v(z) is the expected value: the
// more a step relies on regions without samples, the less gain it predicts. To first order |r|^2
// changes by 2 r_c'd. With this in place of d, s^2 noise is the variance of the target caused by
// noise.
//
// This is not the Gauss-Newton method of DFO-LS [Cartis, Fiala, Marteau, Roberts, ACM TOMS 45
// (2019) 32], whose models of residuals are linear: here the models have curvature, any number of
// samples makes a model, and steps are penalized for the variance of the model. Convergence proofs
// of trust regions with fully linear models do not apply: samples are not kept poised for every
// radius, and the radius is not tied to the size of a slope. The search is judged by test problems,
// ./bench.sh more_wild and more_wild_varied.
#pragma once

#include <Eigen/Core>

#include "numerics/dense/cholesky.h"

namespace latsch {

/// Variance of the slopes that remains if the residuals are known at sample points, one in each row
/// of Z:  V_g I - V_g^2 Z' K^-1 Z.
struct SlopeVariance {
  Eigen::VectorXd share;       // share of V_g, ascending: 0 known, 1 unknown
  Eigen::MatrixXd directions;  // columns of length 1, in the order of the shares
};

SlopeVariance slope_variance(const Eigen::MatrixXd& Z);

/// Samples around a center.
struct ResidualSamples {
  Eigen::MatrixXd Z;       // sample points, one in each row
  Eigen::MatrixXd D;       // r(z_i) - r_c, one a row
  Eigen::VectorXd r_c;     // residuals at the center
  Eigen::MatrixXd slopes;  // Jacobian at the center with respect to z; empty: not known
};

/// Factors of a matrix K = S A S, where S is diagonal and A has ones on its diagonal. The scaling
/// removes the effect of the samples' distances, which differ by orders of magnitude.
class ScaledFactors {
 public:
  ScaledFactors() = default;
  explicit ScaledFactors(const Eigen::MatrixXd& K);
  /// Returns K^-1 D.
  Eigen::MatrixXd solve(const Eigen::MatrixXd& D) const;

 private:
  Eigen::VectorXd scale_;
  numerics::PivotedCholesky factors_;
};

class ResidualKriging {
 public:
  /// `noise` is the variance of the noise in units of the variance of the curvatures.
  ResidualKriging(const ResidualSamples& samples, double noise);

  Eigen::VectorXd residuals(const Eigen::VectorXd& z) const;
  Eigen::MatrixXd jacobian(const Eigen::VectorXd& z) const;

  /// Standard deviation of |r|^2 at a point that is due to noise; 0 without noise.
  double target_deviation() const;
  /// Norm that noise gives the residuals of a point, root of the sum of variances; 0 without noise.
  double noise_norm() const;
  /// Returns |r_hat|^2 + v.
  double expected(const Eigen::VectorXd& z) const;
  /// Half the gradient of v, and the positive semidefinite part of half its Hessian.
  Eigen::VectorXd variance_gradient(const Eigen::VectorXd& z) const;
  Eigen::MatrixXd variance_hessian(const Eigen::VectorXd& z) const;

 private:
  double variance(const Eigen::VectorXd& z) const;  // v
  /// The covariances k(z_i, z) without noise, and their gradients, one row for each sample.
  Eigen::VectorXd kernel(const Eigen::VectorXd& z) const;
  Eigen::MatrixXd kernel_slopes(const Eigen::VectorXd& z) const;

  ResidualSamples samples_;
  double slope_prior_;  // variance V_g of the slopes; 0 if the slopes are known
  double noise_;
  ScaledFactors factors_;   // factors of K
  Eigen::MatrixXd alpha_;   // a residual a row
  double amplitude_ = 0.0;  // s^2; 0 if unknown
  double of_target_ = 0.0;  // s^2 of |r|^2 to first order, with 2 r_c'd in place of d
};

/// Returns the noise for which the samples are most likely, chosen from values that differ by
/// factors of a hundred. Returns 0 if stronger cubic terms, or no noise at all, explain the samples
/// as well.
double likeliest_noise(const ResidualSamples& samples);

}  // namespace latsch
