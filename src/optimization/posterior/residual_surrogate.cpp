// SPDX-License-Identifier: Apache-2.0
#include "optimization/posterior/residual_surrogate.h"

#include <algorithm>
#include <cmath>

#include "numerics/dense/orthogonal_factors.h"

namespace latsch {
namespace {

constexpr double kSlopeTerm = 1000.0;  // first coefficient of (1)
// Relative increase of the diagonal of K that keeps it positive definite in spite of rounding.
constexpr double kSurrogateRounding = 1e-11;
constexpr double kLeastPivot = 1e-30;  // pivot of a sample at the fit itself, whose kernel may be 0

}  // namespace

Eigen::VectorXd WhitenedFrame::whitened(const Eigen::VectorXd& u) const {
  return T.triangularView<Eigen::Lower>().solve(u - center);
}

WhitenedFrame whitened_frame(const Eigen::VectorXd& center, const Eigen::MatrixXd& J) {
  Eigen::MatrixXd information = J.transpose() * J;
  information.diagonal().array() += kInsideCube;
  const numerics::Cholesky factor(information);
  const Eigen::Index n = center.size();
  Eigen::MatrixXd covariance(n, n);
  for (Eigen::Index i = 0; i < n; ++i)
    covariance.col(i) = factor.solve(Eigen::VectorXd(Eigen::VectorXd::Unit(n, i)));
  return {center, 2.0 * numerics::Cholesky(0.5 * (covariance + covariance.transpose())).L()};
}

double ResidualSurrogate::kernel(double g) const {
  const double bent = g * g * (0.5 + g * (1.0 / 60.0 + g / 1200.0));
  return slope_prior_ == 0.0 ? bent : slope_prior_ * (1.0 + g) + bent;  // (1)
}

double ResidualSurrogate::kernel_slope(double g) const {
  const double bent = g * (1.0 + g * (1.0 / 20.0 + g / 300.0));
  return slope_prior_ + bent;
}

ResidualSurrogate::ResidualSurrogate(const SurrogateSamples& samples)
    : Y_(samples.Y), slope_prior_(samples.slopes_exact ? 0.0 : kSlopeTerm) {
  const Eigen::Index N = Y_.rows(), n = samples.J.cols(), m = samples.r_c.size();
  basis_.resize(m, 1 + n + N);
  basis_.leftCols(1 + n) << samples.r_c, samples.J;
  if (N > 0) {
    Eigen::MatrixXd K =
        (Y_ * Y_.transpose()).unaryExpr([this](double g) { return kernel(g); });  // (2)
    for (Eigen::Index i = 0; i < N; ++i)
      K(i, i) = std::max(K(i, i) * (1.0 + kSurrogateRounding), kLeastPivot);
    scale_ = K.diagonal().cwiseSqrt().cwiseInverse();
    factors_ = numerics::PivotedCholesky(scale_.asDiagonal() * K * scale_.asDiagonal());
    Eigen::MatrixXd D = samples.R - Y_ * samples.J.transpose();
    D.rowwise() -= samples.r_c.transpose();
    const Eigen::MatrixXd scaled = scale_.asDiagonal() * D;
    basis_.rightCols(N) = (scale_.asDiagonal() * factors_.solve(scaled)).transpose();  // (3)
  }
  reduced_ = m > basis_.cols() ? numerics::HouseholderQr(basis_).R() : basis_;
}

Eigen::VectorXd ResidualSurrogate::weights(const Eigen::VectorXd& y) const {
  const Eigen::Index N = Y_.rows(), n = y.size();
  Eigen::VectorXd w(1 + n + N);
  w[0] = 1.0;
  w.segment(1, n) = y;
  if (N > 0) {
    w.tail(N).noalias() = Y_ * y;
    for (double& g : w.tail(N)) g = kernel(g);
  }
  return w;
}

double ResidualSurrogate::sum_of_squares(const Eigen::VectorXd& y) const {
  const Eigen::VectorXd w = weights(y);
  if (reduced_.rows() == reduced_.cols())
    return (reduced_.triangularView<Eigen::Upper>() * w).squaredNorm();
  return (reduced_ * w).squaredNorm();
}

Eigen::VectorXd ResidualSurrogate::residuals(const Eigen::VectorXd& y) const {
  return basis_ * weights(y);
}

Eigen::MatrixXd ResidualSurrogate::weight_slopes(const Eigen::VectorXd& y) const {
  const Eigen::Index N = Y_.rows(), n = y.size();
  Eigen::MatrixXd slopes = Eigen::MatrixXd::Zero(1 + n + N, n);
  slopes.middleRows(1, n).setIdentity();
  if (N > 0) {
    Eigen::VectorXd slope = Y_ * y;
    for (double& g : slope) g = kernel_slope(g);
    slopes.bottomRows(N) = slope.asDiagonal() * Y_;
  }
  return slopes;
}

Eigen::MatrixXd ResidualSurrogate::residuals_at(const Eigen::MatrixXd& points) const {
  Eigen::MatrixXd W(basis_.cols(), points.cols());
  for (Eigen::Index k = 0; k < points.cols(); ++k) W.col(k) = weights(points.col(k));
  return basis_ * W;
}

double ResidualSurrogate::variance(const Eigen::VectorXd& y) const {
  return covariance(y.transpose())(0, 0);
}

Eigen::MatrixXd ResidualSurrogate::covariance(const Eigen::MatrixXd& points) const {
  const auto k = [this](double g) { return kernel(g); };
  Eigen::MatrixXd C = (points * points.transpose()).unaryExpr(k);
  if (Y_.rows() > 0) {
    const Eigen::MatrixXd cross = scale_.asDiagonal() * (Y_ * points.transpose()).unaryExpr(k);
    C -= cross.transpose() * factors_.solve(cross);
  }
  C.diagonal() = C.diagonal().cwiseMax(0.0);  // (4)
  return C;
}

}  // namespace latsch
