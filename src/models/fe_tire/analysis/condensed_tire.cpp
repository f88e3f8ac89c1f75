// SPDX-License-Identifier: Apache-2.0
#include "models/fe_tire/analysis/condensed_tire.h"

#include <algorithm>

#include "numerics/sparse/front_algebra.h"

namespace latsch::fe_tire {
namespace {

/// Converts a vector to single precision after dividing it by `scale`, so that its values lie in
/// the middle of the exponent range.
Eigen::VectorXf single(const Eigen::VectorXd& v, double scale) { return (v / scale).cast<float>(); }

double scale_of(const Eigen::VectorXd& v) {
  const double largest = v.size() > 0 ? v.cwiseAbs().maxCoeff() : 0.0;
  return largest > 0.0 ? largest : 1.0;
}

}  // namespace

bool CondensedTire::set(const Eigen::MatrixXd& S, const std::vector<int>& reached) {
  reached_ = reached;
  beyond_.clear();
  factor_ = Factor::none;
  std::size_t next = 0;
  for (int row = 0; row < S.rows(); ++row) {
    if (next < reached.size() && reached[next] == row)
      ++next;
    else
      beyond_.push_back(row);
  }
  std::vector<int> order = beyond_;
  order.insert(order.end(), reached.begin(), reached.end());
  A_ = S(order, beyond_).cast<float>();
  T_ = S(reached, reached);
  const int n = static_cast<int>(order.size()), k = static_cast<int>(beyond_.size()), m = n - k;
  if (k == 0) return true;
  if (!numerics::cholesky(k, A_.data(), n)) return false;
  if (m == 0) return true;
  numerics::solve_right_transposed(m, k, A_.data(), n, A_.data() + k);
  Eigen::MatrixXf taken(m, m);
  numerics::negative_square(m, k, A_.data() + k, n, taken.data());
  T_.triangularView<Eigen::Lower>() += taken.cast<double>();
  T_.triangularView<Eigen::StrictlyUpper>() = T_.transpose();
  return true;
}

Eigen::VectorXd CondensedTire::reduce(Eigen::VectorXd& v) const {
  Eigen::VectorXd within = v(reached_);
  const int k = static_cast<int>(beyond_.size()), m = static_cast<int>(reached_.size());
  if (k == 0) return within;
  const Eigen::VectorXd outside = v(beyond_);
  const double scale = scale_of(outside);
  Eigen::VectorXf eliminated = single(outside, scale);
  numerics::solve_lower(k, 1, A_.data(), k + m, eliminated.data(), k);
  v(beyond_) = scale * eliminated.cast<double>();
  if (m == 0) return within;
  Eigen::VectorXf coupled(m);
  numerics::multiply(m, 1, k, A_.data() + k, k + m, eliminated.data(), k, coupled.data());
  return within - scale * coupled.cast<double>();
}

void CondensedTire::expand(const Eigen::VectorXd& within, Eigen::VectorXd& v) const {
  v(reached_) = within;
  const int k = static_cast<int>(beyond_.size()), m = static_cast<int>(reached_.size());
  if (k == 0) return;
  const Eigen::VectorXd eliminated = v(beyond_);
  const double scale = std::max(scale_of(eliminated), scale_of(within));
  Eigen::VectorXf found = single(eliminated, scale);
  if (m > 0) {
    const Eigen::VectorXf known = single(within, scale);
    numerics::subtract_transposed(k, 1, m, A_.data() + k, k + m, known.data(), found.data(), k);
  }
  numerics::solve_lower_transposed(k, 1, A_.data(), k + m, found.data(), k);
  v(beyond_) = scale * found.cast<double>();
}

void CondensedTire::factorize(const GroundTangent& tangent) {
  const int m = static_cast<int>(T_.rows());
  const auto add = [&](const Eigen::MatrixXd& C) {
    L_(tangent.rows, tangent.rows) += C.cast<float>();
  };
  L_ = T_.cast<float>();
  add(tangent.stiffness);
  factor_ = Factor::cholesky;
  is_positive_ = true;
  if (m == 0) return;
  if (tangent.is_symmetric()) {
    if (numerics::cholesky(m, L_.data(), m)) return;
    is_positive_ = false;
    L_ = T_.cast<float>();
    add(tangent.stiffness);
  } else {
    add(tangent.coupling);
  }
  rows_.resize(m);
  numerics::factorize_lu(m, L_.data(), rows_.data());
  factor_ = Factor::lu;
}

void CondensedTire::solve(Eigen::VectorXd& v) const {
  const int m = static_cast<int>(L_.rows());
  if (m == 0) return;
  const double scale = scale_of(v);
  Eigen::VectorXf x = single(v, scale);
  if (factor_ == Factor::lu) {
    numerics::solve_lu(m, L_.data(), rows_.data(), x.data());
  } else {
    numerics::solve_lower(m, 1, L_.data(), m, x.data(), m);
    numerics::solve_lower_transposed(m, 1, L_.data(), m, x.data(), m);
  }
  v = scale * x.cast<double>();
}

Eigen::VectorXd product(const GroundTangent& tangent, const Eigen::VectorXd& v) {
  Eigen::VectorXd Cv = Eigen::VectorXd::Zero(v.size());
  if (tangent.rows.empty()) return Cv;
  const Eigen::VectorXd at_rows = v(tangent.rows);
  Eigen::VectorXd found = tangent.stiffness * at_rows;
  if (!tangent.is_symmetric()) found += tangent.coupling * at_rows;
  Cv(tangent.rows) = found;
  return Cv;
}

}  // namespace latsch::fe_tire
