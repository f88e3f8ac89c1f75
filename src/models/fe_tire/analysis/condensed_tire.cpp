// SPDX-License-Identifier: Apache-2.0
#include "models/fe_tire/analysis/condensed_tire.h"

#include <utility>

#include "numerics/dense/lu.h"
#include "numerics/sparse/front_algebra.h"

namespace latsch::fe_tire {
namespace {

int size_of(const Eigen::MatrixXd& square) { return static_cast<int>(square.rows()); }

bool cholesky(Eigen::MatrixXd& A) { return numerics::cholesky(size_of(A), A.data(), size_of(A)); }

/// X <- A^-1 X of the factor L of A.
template <class Columns>
void solve(const Eigen::MatrixXd& L, Columns& X) {
  const int n = size_of(L), columns = static_cast<int>(X.cols());
  numerics::solve_lower(n, columns, L.data(), n, X.data(), n);
  numerics::solve_lower_transposed(n, columns, L.data(), n, X.data(), n);
}

void solve_with_lu(const Eigen::MatrixXd& A, Eigen::VectorXd& b) {
  numerics::Lu lu;
  lu.factorize(A);
  Eigen::MatrixXd column = b;
  lu.solve(column);
  b = column.col(0);
}

}  // namespace

void CondensedTire::set(Eigen::MatrixXd S) {
  S_ = std::move(S);
  L_ = S_;
  is_positive_ = cholesky(L_);
  F_.clear();
  rows_.clear();
}

/// F P, [n x m].
Eigen::MatrixXd CondensedTire::columns(const std::vector<int>& rows) {
  std::vector<int> missing;
  for (const int row : rows)
    if (!F_.contains(row)) missing.push_back(row);
  Eigen::MatrixXd found = Eigen::MatrixXd::Zero(S_.rows(), std::ssize(missing));
  for (Eigen::Index k = 0; k < found.cols(); ++k) found(missing[k], k) = 1.0;
  fe_tire::solve(L_, found);
  for (Eigen::Index k = 0; k < found.cols(); ++k) F_.emplace(missing[k], found.col(k));
  Eigen::MatrixXd all(S_.rows(), std::ssize(rows));
  for (Eigen::Index k = 0; k < all.cols(); ++k) all.col(k) = F_.at(rows[k]);
  return all;
}

Eigen::MatrixXd CondensedTire::whole(const GroundTangent& tangent) const {
  Eigen::MatrixXd sum = S_;
  sum(tangent.rows, tangent.rows) += tangent.stiffness;
  return sum;
}

Eigen::VectorXd CondensedTire::newton_step(const GroundTangent& tangent, const Eigen::VectorXd& r) {
  Eigen::VectorXd step = r;
  Eigen::MatrixXd by_rows = tangent.stiffness;
  if (tangent.coupling.size() > 0) by_rows += tangent.coupling;
  if (!is_positive_) {
    Eigen::MatrixXd sum = S_;
    sum(tangent.rows, tangent.rows) += by_rows;
    solve_with_lu(sum, step);
    return step;
  }
  fe_tire::solve(L_, step);
  if (tangent.rows.empty()) return step;
  const Eigen::MatrixXd FP = columns(tangent.rows);
  Eigen::MatrixXd small = FP(tangent.rows, Eigen::all) * by_rows;
  small.diagonal().array() += 1.0;
  Eigen::VectorXd at_rows = step(tangent.rows);
  solve_with_lu(small, at_rows);
  step -= FP * (by_rows * at_rows);
  return step;
}

bool CondensedTire::take(const GroundTangent& tangent) {
  rows_ = tangent.rows;
  C_ = tangent.stiffness;
  if (!is_positive_) {
    L_ = whole(tangent);
    return cholesky(L_);
  }
  if (rows_.empty()) return true;
  FP_ = columns(rows_);
  R_ = FP_(rows_, Eigen::all);
  if (!cholesky(R_)) return false;
  R_ = R_.triangularView<Eigen::Lower>().toDenseMatrix();
  M_ = R_.transpose() * C_ * R_;
  M_.diagonal().array() += 1.0;
  return cholesky(M_);
}

void CondensedTire::solve(Eigen::VectorXd& v) const {
  fe_tire::solve(L_, v);
  if (!is_positive_ || rows_.empty()) return;
  const Eigen::VectorXd z = C_ * v(rows_);
  Eigen::VectorXd q = R_.transpose() * z;
  fe_tire::solve(M_, q);
  v -= FP_ * (z - C_ * (R_ * q));
}

Eigen::VectorXd CondensedTire::multiply_ground(const Eigen::VectorXd& v) const {
  Eigen::VectorXd product = Eigen::VectorXd::Zero(v.size());
  if (!rows_.empty()) product(rows_) = C_ * v(rows_);
  return product;
}

}  // namespace latsch::fe_tire
