// SPDX-License-Identifier: Apache-2.0
#include "numerics/periodic_spline.h"

#include <algorithm>
#include <cassert>
#include <cmath>
#include <utility>

namespace latsch::numerics {
namespace {

/// Solves a cyclic system with the diagonal 2 (h_{i-1} + h_i) and the neighbors h_{i-1}, h_i by
/// elimination and one correction for the corners (Sherman and Morrison). Rows of `b` are
/// right-hand sides.
Eigen::MatrixXd solve_cyclic(const std::vector<double>& h, const Eigen::MatrixXd& b) {
  const auto n = static_cast<Eigen::Index>(h.size());
  const auto diagonal = [&](Eigen::Index i) { return 2.0 * (h[(i + n - 1) % n] + h[i]); };
  const double corner = h[n - 1], gamma = -diagonal(0);
  // The corners are the outer product of u = (gamma, 0 ... 0, corner) and
  // v = (1, 0 ... corner/gamma).
  Eigen::MatrixXd rows(b.rows() + 1, n);
  rows.topRows(b.rows()) = b;
  rows.bottomRows(1).setZero();
  rows(b.rows(), 0) = gamma;
  rows(b.rows(), n - 1) = corner;
  std::vector<double> pivot(n);
  for (Eigen::Index i = 0; i < n; ++i) {
    pivot[i] = diagonal(i) - (i == 0 ? gamma : i == n - 1 ? corner * corner / gamma : 0.0);
    if (i == 0) continue;
    const double factor = h[i - 1] / pivot[i - 1];
    pivot[i] -= factor * h[i - 1];
    rows.col(i) -= factor * rows.col(i - 1);
  }
  for (Eigen::Index i = n - 1; i >= 0; --i) {
    if (i + 1 < n) rows.col(i) -= h[i] * rows.col(i + 1);
    rows.col(i) /= pivot[i];
  }
  const Eigen::VectorXd z = rows.bottomRows(1).transpose();
  const auto by_v = [&](const auto& x) { return (x(0) + x(n - 1) * corner / gamma); };
  Eigen::MatrixXd x = rows.topRows(b.rows());
  for (Eigen::Index k = 0; k < x.rows(); ++k)
    x.row(k) -= by_v(x.row(k)) / (1.0 + by_v(z)) * z.transpose();
  return x;
}

}  // namespace

PeriodicSpline::PeriodicSpline(std::vector<double> t, double period, Eigen::MatrixXd values)
    : t_(std::move(t)), period_(period), y_(std::move(values)) {
  const auto n = static_cast<Eigen::Index>(t_.size());
  assert(n >= 3 && y_.cols() == n && t_.back() - t_.front() < period);
  std::vector<double> h(n);
  for (Eigen::Index i = 0; i < n; ++i)
    h[i] = i + 1 < n ? t_[i + 1] - t_[i] : t_[0] + period_ - t_[i];
  Eigen::MatrixXd b(y_.rows(), n);
  for (Eigen::Index i = 0; i < n; ++i) {
    const Eigen::Index before = (i + n - 1) % n, after = (i + 1) % n;
    b.col(i) =
        6.0 * ((y_.col(after) - y_.col(i)) / h[i] - (y_.col(i) - y_.col(before)) / h[before]);
  }
  second_ = solve_cyclic(h, b);
}

PeriodicSpline::At PeriodicSpline::at(double t) const {
  const auto n = static_cast<Eigen::Index>(t_.size());
  const double turns = std::floor((t - t_[0]) / period_);
  const double inside = t - turns * period_;
  const auto next = std::upper_bound(t_.begin(), t_.end(), inside);
  const Eigen::Index i = std::max<Eigen::Index>(0, next - t_.begin() - 1), j = (i + 1) % n;
  const double h = j > 0 ? t_[j] - t_[i] : t_[0] + period_ - t_[i];
  const double b = (inside - t_[i]) / h, a = 1.0 - b;
  At at;
  at.value = a * y_.col(i) + b * y_.col(j) +
             h * h / 6.0 * ((a * a * a - a) * second_.col(i) + (b * b * b - b) * second_.col(j));
  at.first =
      (y_.col(j) - y_.col(i)) / h +
      h / 6.0 * ((1.0 - 3.0 * a * a) * second_.col(i) + (3.0 * b * b - 1.0) * second_.col(j));
  at.second = a * second_.col(i) + b * second_.col(j);
  return at;
}

}  // namespace latsch::numerics
