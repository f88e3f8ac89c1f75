// SPDX-License-Identifier: Apache-2.0
#include "optimization/least_squares/residual_kriging.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>

#include "numerics/dense/self_adjoint_eigen.h"

namespace latsch {
namespace {

constexpr double kSlopeVariance = 1e4;   // V_g
constexpr double kCubicVariance = 1e-4;  // rho
// Relative increase of the diagonal of K that keeps K positive definite in spite of rounding.
constexpr double kRounding = 1e-13;
constexpr double kClear = 6.0;  // gain in log likelihood from which on noise is assumed
// Number of residuals from which the noise is estimated; more would not change the result.
constexpr Eigen::Index kEnough = 128;

/// Returns K with the diagonal terms of equation (2).
Eigen::MatrixXd covariance(const Eigen::MatrixXd& Z, double V_g, double rho, double noise) {
  const Eigen::ArrayXXd inner = (Z * Z.transpose()).array();
  Eigen::MatrixXd K = (V_g * inner + 0.5 * inner.square() + noise).matrix();  // (1)
  K.diagonal().array() += rho * Z.rowwise().squaredNorm().array().cube() + noise;
  K.diagonal() *= 1.0 + kRounding;
  return K;
}

/// Returns the differences of the residuals without the part that known slopes explain.
Eigen::MatrixXd unexplained(const ResidualSamples& samples) {
  if (samples.slopes.size() == 0) return samples.D;
  return samples.D - samples.Z * samples.slopes.transpose();
}

/// Returns kEnough columns spread evenly over D if D has more, because neighboring residuals
/// contain the same information.
Eigen::MatrixXd some_of(const Eigen::MatrixXd& D) {
  const Eigen::Index m = D.cols();
  if (m <= kEnough) return D;
  Eigen::MatrixXd some(D.rows(), kEnough);
  for (Eigen::Index j = 0; j < kEnough; ++j) some.col(j) = D.col(j * m / kEnough);
  return some;
}

double slope_prior(const ResidualSamples& samples) {
  return samples.slopes.size() > 0 ? 0.0 : kSlopeVariance;
}

/// Returns the log likelihood of the columns of D, each with its most likely amplitude.
double likelihood(const Eigen::MatrixXd& K, const Eigen::MatrixXd& D, double floor) {
  const numerics::Cholesky factors(K);
  if (!factors.is_positive_definite()) return -std::numeric_limits<double>::infinity();
  const Eigen::MatrixXd half = factors.solve_lower(D);
  const Eigen::ArrayXd square = half.colwise().squaredNorm().transpose().array() + floor;
  return -0.5 * static_cast<double>(D.cols()) * factors.log_determinant() -
         0.5 * static_cast<double>(D.rows()) * square.log().sum();
}

}  // namespace

ScaledFactors::ScaledFactors(const Eigen::MatrixXd& K)
    : scale_(K.diagonal().cwiseSqrt().cwiseInverse()),
      factors_(scale_.asDiagonal() * K * scale_.asDiagonal()) {}

Eigen::MatrixXd ScaledFactors::solve(const Eigen::MatrixXd& D) const {
  const Eigen::MatrixXd scaled = scale_.asDiagonal() * D;
  return scale_.asDiagonal() * factors_.solve(scaled);
}

SlopeVariance slope_variance(const Eigen::MatrixXd& Z) {
  Eigen::MatrixXd left = Eigen::MatrixXd::Identity(Z.cols(), Z.cols());
  if (Z.rows() > 0) {
    const Eigen::MatrixXd K = covariance(Z, kSlopeVariance, kCubicVariance, 0.0);
    left -= kSlopeVariance * Z.transpose() * ScaledFactors(K).solve(Z);
  }
  const auto [values, vectors] = numerics::self_adjoint_eigen(left);
  return {values, vectors};
}

ResidualKriging::ResidualKriging(const ResidualSamples& samples, double noise)
    : samples_(samples), slope_prior_(slope_prior(samples)), noise_(noise) {
  if (samples.Z.rows() == 0) return;
  factors_ = ScaledFactors(covariance(samples.Z, slope_prior_, kCubicVariance, noise));
  const Eigen::MatrixXd D = unexplained(samples);
  const Eigen::MatrixXd alpha = factors_.solve(D);  // (2)
  amplitude_ = std::max(0.0, alpha.cwiseProduct(D).sum()) / static_cast<double>(D.rows());
  alpha_ = alpha.transpose();
  const double square = 4.0 * (alpha * samples.r_c).dot(D * samples.r_c);
  of_target_ = std::max(0.0, square) / static_cast<double>(D.rows());
}

double ResidualKriging::target_deviation() const { return std::sqrt(noise_ * of_target_); }

double ResidualKriging::noise_norm() const { return std::sqrt(noise_ * amplitude_); }

Eigen::VectorXd ResidualKriging::kernel(const Eigen::VectorXd& z) const {
  const Eigen::ArrayXd inner = (samples_.Z * z).array();
  return slope_prior_ * inner + 0.5 * inner.square();  // (1)
}

Eigen::MatrixXd ResidualKriging::kernel_slopes(const Eigen::VectorXd& z) const {
  const Eigen::VectorXd slope = slope_prior_ + (samples_.Z * z).array();
  return slope.asDiagonal() * samples_.Z;
}

Eigen::VectorXd ResidualKriging::residuals(const Eigen::VectorXd& z) const {
  Eigen::VectorXd r = samples_.r_c;
  if (samples_.slopes.size() > 0) r += samples_.slopes * z;
  if (samples_.Z.rows() == 0) return r;
  return r + alpha_ * (kernel(z).array() + noise_).matrix();  // (3)
}

Eigen::MatrixXd ResidualKriging::jacobian(const Eigen::VectorXd& z) const {
  Eigen::MatrixXd J = samples_.slopes;
  if (J.size() == 0) J = Eigen::MatrixXd::Zero(samples_.r_c.size(), z.size());
  if (samples_.Z.rows() == 0) return J;
  return J + alpha_ * kernel_slopes(z);
}

double ResidualKriging::variance(const Eigen::VectorXd& z) const {
  if (amplitude_ == 0.0) return 0.0;
  const double zz = z.squaredNorm();
  const Eigen::VectorXd k = kernel(z);
  const double open = slope_prior_ * zz + 0.5 * zz * zz - k.dot(factors_.solve(k).col(0));
  return amplitude_ * (std::max(0.0, open) + kCubicVariance * zz * zz * zz);  // (4)
}

double ResidualKriging::expected(const Eigen::VectorXd& z) const {
  return residuals(z).squaredNorm() + variance(z);
}

Eigen::VectorXd ResidualKriging::variance_gradient(const Eigen::VectorXd& z) const {
  if (amplitude_ == 0.0) return Eigen::VectorXd::Zero(z.size());
  const double zz = z.squaredNorm();
  const double along = slope_prior_ + zz + 3.0 * kCubicVariance * zz * zz;
  return amplitude_ * (along * z - kernel_slopes(z).transpose() * factors_.solve(kernel(z)));
}

// v is proportional to |phi(z)|^2 minus its part in the span of the samples, where phi contains all
// z_i and z_i z_j with their weights. Returns the positive semidefinite (Gauss-Newton) part of the
// Hessian.
Eigen::MatrixXd ResidualKriging::variance_hessian(const Eigen::VectorXd& z) const {
  if (amplitude_ == 0.0) return Eigen::MatrixXd::Zero(z.size(), z.size());
  const double zz = z.squaredNorm();
  const Eigen::MatrixXd A = kernel_slopes(z);
  Eigen::MatrixXd H = (1.0 + 6.0 * kCubicVariance * zz) * z * z.transpose();
  H -= A.transpose() * factors_.solve(A);
  H.diagonal().array() += slope_prior_ + zz + 3.0 * kCubicVariance * zz * zz;
  return amplitude_ * H;
}

double likeliest_noise(const ResidualSamples& samples) {
  struct Explanation {
    double rho, noise;
  };
  constexpr std::array<Explanation, 9> kExplanations{{{kCubicVariance, 0.0},
                                                      {1e-2, 0.0},
                                                      {1.0, 0.0},
                                                      {1e2, 0.0},
                                                      {kCubicVariance, 1e-2},
                                                      {kCubicVariance, 1.0},
                                                      {kCubicVariance, 1e2},
                                                      {kCubicVariance, 1e4},
                                                      {kCubicVariance, 1e6}}};
  // A quadratic explains so few samples exactly, whatever their values, so they show no noise.
  if (samples.Z.rows() < samples.Z.cols() + 2) return 0.0;
  const Eigen::MatrixXd D = some_of(unexplained(samples));
  // Prevents a division by zero for a residual that never changes.
  const double floor =
      1e-20 * D.squaredNorm() / kSlopeVariance + std::numeric_limits<double>::min();
  double best = -std::numeric_limits<double>::infinity();
  double likeliest = 0.0;
  for (const auto& [rho, noise] : kExplanations) {
    const Eigen::MatrixXd K = covariance(samples.Z, slope_prior(samples), rho, noise);
    const double now = likelihood(K, D, floor) - (noise > 0.0 ? kClear : 0.0);
    if (now <= best) continue;
    best = now;
    likeliest = noise;
  }
  return likeliest;
}

}  // namespace latsch
