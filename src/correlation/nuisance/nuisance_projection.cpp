// SPDX-License-Identifier: Apache-2.0
#include "correlation/nuisance/nuisance_projection.h"

#include <cmath>

namespace latsch::correlation {
namespace {

/// Share of a column's length beyond the columns before it below which the column depends on them.
/// Rounding of differences leaves about 1e-16 times the number of values.
constexpr double kDependent = 1e-10;

}  // namespace

NuisanceProjection::NuisanceProjection(const Eigen::MatrixXd& A, const Eigen::VectorXd& sigma)
    : rows_(A.rows()), numbers_(A.cols()), sigma_(sigma) {
  Eigen::MatrixXd B = Eigen::MatrixXd::Zero(rows_ + numbers_, numbers_);
  B.topRows(rows_) = A;
  for (Eigen::Index k = 0; k < numbers_; ++k)
    if (std::isfinite(sigma[k])) B(rows_ + k, k) = 1.0 / sigma[k];
  Q_.resize(rows_ + numbers_, numbers_);
  R_ = Eigen::MatrixXd::Zero(numbers_, numbers_);
  Eigen::Index rank = 0;
  for (Eigen::Index k = 0; k < numbers_; ++k) {
    Eigen::VectorXd column = B.col(k);
    const double length = column.norm();
    for (int pass = 0; pass < 2; ++pass) {
      for (Eigen::Index j = 0; j < rank; ++j) {
        const double along = Q_.col(j).dot(column);
        R_(j, rank) += along;
        column -= along * Q_.col(j);
      }
    }
    const double left = column.norm();
    if (!(left > kDependent * length)) {
      R_.col(rank).setZero();
      place_.push_back(-1);
      continue;
    }
    R_(rank, rank) = left;
    Q_.col(rank) = column / left;
    place_.push_back(rank++);
    number_.push_back(k);
  }
  Q_.conservativeResize(Eigen::NoChange, rank);
  R_.conservativeResize(rank, rank);
}

Eigen::MatrixXd NuisanceProjection::solved(const Eigen::MatrixXd& right) const {
  const Eigen::Index rank = Q_.cols();
  Eigen::MatrixXd x = Q_.transpose() * right;
  for (Eigen::Index i = rank - 1; i >= 0; --i) {
    for (Eigen::Index j = i + 1; j < rank; ++j) x.row(i) -= R_(i, j) * x.row(j);
    x.row(i) /= R_(i, i);
  }
  Eigen::MatrixXd all = Eigen::MatrixXd::Zero(numbers_, right.cols());
  for (Eigen::Index i = 0; i < rank; ++i) all.row(number_[static_cast<std::size_t>(i)]) = x.row(i);
  return all;
}

Eigen::VectorXd NuisanceProjection::step(const Eigen::VectorXd& r, const Eigen::VectorXd& z) const {
  Eigen::VectorXd right(rows_ + numbers_);
  right.head(rows_) = r;
  for (Eigen::Index k = 0; k < numbers_; ++k)
    right[rows_ + k] = std::isfinite(sigma_[k]) ? z[k] / sigma_[k] : 0.0;
  return -solved(right);
}

Eigen::MatrixXd NuisanceProjection::following(const Eigen::MatrixXd& J) const {
  Eigen::MatrixXd right = Eigen::MatrixXd::Zero(rows_ + numbers_, J.cols());
  right.topRows(rows_) = J;
  return -solved(right);
}

Eigen::MatrixXd NuisanceProjection::covariance() const {
  // R^-1, one row for each number; the covariance is its product with its own transpose
  const Eigen::MatrixXd inverse = solved(Q_);
  return inverse * inverse.transpose();
}

}  // namespace latsch::correlation
