// SPDX-License-Identifier: Apache-2.0
#include "optimization/identifiability/robust_rows.h"

#include <algorithm>
#include <cassert>
#include <cmath>

#include "numerics/dense/cholesky.h"
#include "numerics/dense/orthogonal_factors.h"
#include "numerics/dense/self_adjoint_eigen.h"
#include "numerics/dense/singular_values.h"
#include "optimization/problem/point_vector.h"

namespace latsch {
namespace {

// Smallest slope dr/dx by which derivatives are divided. Division by a smaller one would leave
// rounding errors.
constexpr double kLeastSlope = 1e-6;
// Smallest curvature as a share of its positive part. A point with less curvature is no minimum.
constexpr double kLeastRowCurvature = 1e-2;
// Share of the largest singular value below which a singular value counts as zero.
constexpr double kRoundingOfRows = 1e-13;

/// Returns the part of x that is orthogonal to the columns of A.
Eigen::VectorXd beside_columns(const Eigen::MatrixXd& A, const Eigen::VectorXd& x) {
  if (A.cols() == 0 || A.rows() == 0) return x;
  const Eigen::MatrixXd Q = numerics::range_basis(A);
  return x - Q * (Q.transpose() * x);
}

}  // namespace

RobustRows::RobustRows(const Eigen::VectorXd& r,
                       const Eigen::MatrixXd& J,
                       const ResidualTraits& traits)
    : X_(J),
      psi_(r),
      slopes_(Eigen::VectorXd::Ones(r.size())),
      psi_slopes_(Eigen::VectorXd::Ones(r.size())),
      deviations_(Eigen::VectorXd::Ones(r.size())),
      is_beyond_(static_cast<size_t>(r.size()), false) {
  if (!traits.deviations.empty()) deviations_ = to_vector(traits.deviations);
  groups_.assign(static_cast<size_t>(r.size()), 0);
  losses_.resize(1);
  if (traits.losses.empty()) return;
  losses_.clear();
  for (Eigen::Index i = 0; i < r.size(); ++i) {
    const auto k = static_cast<size_t>(i);
    RobustLoss loss = traits.losses[k];
    const LimitedResidual one = loss.at(r[i]);
    psi_[i] = one.psi;
    slopes_[i] = one.slope;
    psi_slopes_[i] = one.psi_slope;
    is_beyond_[k] = one.is_beyond;
    with_loss_ += loss.loss == Loss::squares ? 0 : 1;
    beyond_ += one.is_beyond ? 1 : 0;
    is_limited_ = is_limited_ || one.psi_slope != 1.0;
    if (one.slope < kLeastSlope) {
      X_.row(i).setZero();
    } else if (one.slope != 1.0) {
      X_.row(i) /= one.slope;
    }
    loss.scale = loss.loss == Loss::squares ? 1.0 : loss.scale / deviations_[i];
    const auto known = std::find(losses_.begin(), losses_.end(), loss);
    groups_[k] = static_cast<int>(known - losses_.begin());
    if (known == losses_.end()) losses_.push_back(loss);
  }
}

Eigen::VectorXd RobustRows::felt_changes() const {
  const Eigen::ArrayXd slope = slopes_.array().max(kLeastSlope);
  return psi_slopes_.array() / (slope * slope);
}

double RobustRows::expected_beyond(double sigma) const {
  double sum = 0.0;
  for (const int group : groups_) {
    const RobustLoss& loss = losses_[static_cast<size_t>(group)];
    if (loss.loss != Loss::squares) sum += loss.expected(sigma).beyond;
  }
  return with_loss_ > 0 ? sum / with_loss_ : 0.0;
}

double RobustRows::mean_over(int group, const Eigen::VectorXd& of) const {
  double sum = 0.0, count = 0.0;
  for (size_t k = 0; k < groups_.size(); ++k) {
    if (groups_[k] != group) continue;
    sum += of[static_cast<Eigen::Index>(k)];
    count += 1.0;
  }
  return sum / count;
}

Eigen::VectorXd RobustRows::common_weights() const {
  const double mean = psi_slopes_.mean();
  const double variance = (psi_slopes_.array() - mean).square().mean();
  const double n = static_cast<double>(X_.cols()), m = static_cast<double>(X_.rows());
  const double K = mean > 0.0 ? 1.0 + n / m * variance / (mean * mean) : 1.0;
  Eigen::VectorXd weights(X_.rows());
  for (size_t k = 0; k < groups_.size(); ++k)
    weights[static_cast<Eigen::Index>(k)] = mean_over(groups_[k], psi_slopes_) / K;
  return weights;
}

/// Returns the degree to which the loss of a group limits its values, from 0 (not at all) to 1 (as
/// much as it would limit Gaussian noise, or more).
double RobustRows::limited_share(int group, double sigma) const {
  const double expected = 1.0 - losses_[static_cast<size_t>(group)].expected(sigma).psi_slope;
  const double seen = 1.0 - mean_over(group, psi_slopes_);
  return expected > 0.0 ? std::clamp(seen / expected, 0.0, 1.0) : 0.0;
}

RobustRows::Spreads RobustRows::spreads(const std::optional<double>& stated, double least) const {
  const Eigen::Index m = X_.rows();
  const Eigen::VectorXd units = deviations_.cwiseInverse();
  const Eigen::VectorXd x = psi_.cwiseProduct(units);
  std::vector<Eigen::Index> inside;
  for (Eigen::Index i = 0; i < m; ++i)
    if (!is_beyond_[static_cast<size_t>(i)]) inside.push_back(i);
  const Eigen::MatrixXd G = units.asDiagonal() * X_;
  const auto n = static_cast<double>(numerics::range_basis(G).cols());
  const Eigen::VectorXd left = beside_columns(G, x);
  const Eigen::MatrixXd G_inside = (psi_slopes_.asDiagonal() * G)(inside, Eigen::all);
  const Eigen::VectorXd left_inside = beside_columns(G_inside, x(inside));
  const auto of_freedom = [n](double count) { return count > n ? count / (count - n) : 1.0; };
  const double all = of_freedom(static_cast<double>(m)),
               some = of_freedom(static_cast<double>(inside.size()));
  Spreads spreads{Eigen::VectorXd(m), Eigen::VectorXd(m)};
  for (size_t g = 0; g < losses_.size(); ++g) {
    const int group = static_cast<int>(g);
    double inside_sum = 0.0, inside_count = 0.0;
    for (size_t k = 0; k < inside.size(); ++k) {
      if (groups_[static_cast<size_t>(inside[k])] != group) continue;
      inside_sum +=
          left_inside[static_cast<Eigen::Index>(k)] * left_inside[static_cast<Eigen::Index>(k)];
      inside_count += 1.0;
    }
    double own = inside_count > 0.0 ? some * inside_sum / inside_count : 0.0;
    if (stated) {
      const double lost = 1.0 - losses_[g].expected(*stated).inside;
      own = *stated * *stated * (1.0 - lost * limited_share(group, *stated));
    }
    own = std::max(own, least * least);
    Eigen::VectorXd squares = left.cwiseAbs2();
    for (Eigen::Index i = 0; i < m; ++i) {
      const auto k = static_cast<size_t>(i);
      if (groups_[k] != group) continue;
      spreads.own[i] = is_beyond_[k] ? std::abs(psi_[i]) : std::sqrt(own) * deviations_[i];
      if (stated) squares[i] = is_beyond_[k] ? x[i] * x[i] : own;
    }
    const double common = std::max((stated ? 1.0 : all) * mean_over(group, squares), least * least);
    for (Eigen::Index i = 0; i < m; ++i)
      if (groups_[static_cast<size_t>(i)] == group)
        spreads.common[i] = std::sqrt(common) * deviations_[i];
  }
  return spreads;
}

Eigen::MatrixXd weighted_rows(const Eigen::MatrixXd& J, const Eigen::VectorXd& w) {
  const Eigen::MatrixXd H = w.cwiseMax(0.0).cwiseSqrt().asDiagonal() * J;
  if (w.size() == 0 || w.minCoeff() >= 0.0 || J.cols() == 0) return H;
  const Eigen::MatrixXd N = (-w).cwiseMax(0.0).cwiseSqrt().asDiagonal() * J;
  const auto [values, V] = numerics::singular_values(H);
  const Eigen::Index n = J.cols();
  Eigen::VectorXd s = Eigen::VectorXd::Zero(n), inverse = s;
  s.head(values.size()) = values;
  for (Eigen::Index k = 0; k < n; ++k)
    if (s[k] > kRoundingOfRows * s[0]) inverse[k] = 1.0 / s[k];
  const Eigen::MatrixXd NW = N * V * inverse.asDiagonal();
  const auto [taken, Q] = numerics::self_adjoint_eigen(Eigen::MatrixXd(NW.transpose() * NW));
  const Eigen::VectorXd kept =
      (1.0 - taken.array()).max(kLeastRowCurvature).sqrt();  // H'H - N'N = (S V')' (1 - NW'NW) S V'
  return kept.asDiagonal() * Q.transpose() * s.asDiagonal() * V.transpose();
}

Eigen::MatrixXd larger(const Eigen::MatrixXd& a, const Eigen::MatrixXd& b) {
  if (a.rows() == 0) return a;
  const numerics::Cholesky factor(a);
  if (!factor.is_positive_definite()) return b;
  const Eigen::MatrixXd half = factor.solve_lower(b);
  const Eigen::MatrixXd ratio = factor.solve_lower(Eigen::MatrixXd(half.transpose()));
  const auto [values, Q] =
      numerics::self_adjoint_eigen(Eigen::MatrixXd(0.5 * (ratio + ratio.transpose())));
  const Eigen::MatrixXd LQ = factor.L() * Q;
  return LQ * values.cwiseMax(1.0).asDiagonal() * LQ.transpose();
}

}  // namespace latsch
