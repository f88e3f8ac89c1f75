// SPDX-License-Identifier: Apache-2.0
#include "models/fe_tire/description/contour.h"

#include <Eigen/LU>
#include <algorithm>
#include <cassert>

namespace latsch::fe_tire {
namespace {

// Number of intervals for the arc length, whose relative error is then about 1e-8.
constexpr int kArcSamples = 4000;

Eigen::Matrix2Xd mirrored(const std::vector<MeridianPoint>& half) {
  const int n = static_cast<int>(half.size());
  Eigen::Matrix2Xd p(2, 2 * n - 1);
  for (int i = 0; i < n; ++i) {
    p.col(n - 1 - i) << half[i].y, half[i].r;
    p.col(n - 1 + i) << -half[i].y, half[i].r;
  }
  return p;
}

/// Returns half of the second derivatives of the natural cubic spline at its points, [2 x n].
Eigen::Matrix2Xd spline_curvature(const Eigen::VectorXd& t, const Eigen::Matrix2Xd& p) {
  const Eigen::Index n = t.size();
  Eigen::MatrixXd A = Eigen::MatrixXd::Zero(n, n);
  Eigen::MatrixX2d b = Eigen::MatrixX2d::Zero(n, 2);
  A(0, 0) = A(n - 1, n - 1) = 1.0;
  for (Eigen::Index i = 1; i < n - 1; ++i) {
    const double h0 = t[i] - t[i - 1], h1 = t[i + 1] - t[i];
    A(i, i - 1) = h0;
    A(i, i) = 2.0 * (h0 + h1);
    A(i, i + 1) = h1;
    b.row(i) = 3.0 * ((p.col(i + 1) - p.col(i)) / h1 - (p.col(i) - p.col(i - 1)) / h0).transpose();
  }
  return A.partialPivLu().solve(b).transpose();
}

}  // namespace

Contour::Contour(const std::vector<MeridianPoint>& half) : p_(mirrored(half)) {
  assert(half.size() >= 3);
  const Eigen::Index n = p_.cols();
  t_ = Eigen::VectorXd::Zero(n);
  for (Eigen::Index i = 1; i < n; ++i) t_[i] = t_[i - 1] + (p_.col(i) - p_.col(i - 1)).norm();
  const Eigen::Matrix2Xd c = spline_curvature(t_, p_);
  a1_.resize(2, n - 1);
  a2_ = c.leftCols(n - 1);
  a3_.resize(2, n - 1);
  for (Eigen::Index i = 0; i < n - 1; ++i) {
    const double h = t_[i + 1] - t_[i];
    a1_.col(i) = (p_.col(i + 1) - p_.col(i)) / h - h * (2.0 * c.col(i) + c.col(i + 1)) / 3.0;
    a3_.col(i) = (c.col(i + 1) - c.col(i)) / (3.0 * h);
  }

  const auto at = [&](double t) {
    const auto i = std::clamp<Eigen::Index>(
        std::upper_bound(t_.begin(), t_.end(), t) - t_.begin() - 1, 0, n - 2);
    const double d = t - t_[i];
    return Eigen::Vector2d(p_.col(i) + d * (a1_.col(i) + d * (a2_.col(i) + d * a3_.col(i))));
  };
  arc_.assign(1, 0.0);
  Eigen::Vector2d last = at(0.0);
  for (int i = 1; i <= kArcSamples; ++i) {
    const Eigen::Vector2d next = at(t_[n - 1] * i / kArcSamples);
    arc_.push_back(arc_.back() + (next - last).norm());
    last = next;
  }
  length_ = arc_.back();
}

double Contour::chord(double s) const {
  const double arc = 0.5 * (s + 1.0) * length_;
  const auto next = std::clamp<std::ptrdiff_t>(
      std::upper_bound(arc_.begin(), arc_.end(), arc) - arc_.begin(), 1, kArcSamples);
  const double part = (arc - arc_[next - 1]) / (arc_[next] - arc_[next - 1]);
  return t_[t_.size() - 1] * (next - 1 + part) / kArcSamples;
}

MeridianPoint Contour::point(double s) const {
  const double t = chord(s);
  const auto i = std::clamp<Eigen::Index>(
      std::upper_bound(t_.begin(), t_.end(), t) - t_.begin() - 1, 0, t_.size() - 2);
  const double d = t - t_[i];
  const Eigen::Vector2d p = p_.col(i) + d * (a1_.col(i) + d * (a2_.col(i) + d * a3_.col(i)));
  return {p[0], p[1]};
}

MeridianPoint Contour::tangent(double s) const {
  const double t = chord(s);
  const auto i = std::clamp<Eigen::Index>(
      std::upper_bound(t_.begin(), t_.end(), t) - t_.begin() - 1, 0, t_.size() - 2);
  const double d = t - t_[i];
  const Eigen::Vector2d p =
      (a1_.col(i) + d * (2.0 * a2_.col(i) + 3.0 * d * a3_.col(i))).normalized();
  return {p[0], p[1]};
}

MeridianPoint Contour::offset(double s, double distance) const {
  const MeridianPoint p = point(s), t = tangent(s);
  return {p.y + distance * t.r, p.r - distance * t.y};
}

}  // namespace latsch::fe_tire
