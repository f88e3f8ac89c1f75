// SPDX-License-Identifier: Apache-2.0
#include "models/fe_tire/motion/tread_body.h"

#include <algorithm>
#include <cmath>
#include <map>
#include <utility>

#include "numerics/dense/lu.h"
#include "numerics/sparse/front_algebra.h"

namespace latsch::fe_tire {
namespace {

/// Relative residual of a refined solution, and most refinements. A matrix that needs more is
/// factorized in double precision.
constexpr double kRefined = 1e-11;
constexpr int kMostRefinements = 6;

/// Solves J x = R by a factorization in single precision, which is several times as fast, and
/// residuals in double precision.
bool solve_refined(const Eigen::MatrixXd& J, const Eigen::VectorXd& R, Eigen::VectorXd& x) {
  const int n = static_cast<int>(J.rows());
  const double scale = std::max(J.cwiseAbs().maxCoeff(), 1e-300);
  Eigen::MatrixXf LU = (J / scale).cast<float>();
  std::vector<int> rows(static_cast<std::size_t>(n));
  numerics::factorize_lu(n, LU.data(), rows.data());
  Eigen::VectorXd r = R;
  x = Eigen::VectorXd::Zero(n);
  for (int pass = 0; pass <= kMostRefinements; ++pass) {
    const double size = r.cwiseAbs().maxCoeff();
    if (size <= kRefined * R.cwiseAbs().maxCoeff()) return true;
    if (!std::isfinite(size)) break;
    Eigen::VectorXf step = (r / size).cast<float>();
    numerics::solve_lu(n, LU.data(), rows.data(), step.data());
    x += (size / scale) * step.cast<double>();
    r = R - J * x;
  }
  numerics::Lu lu;
  lu.factorize(J);
  Eigen::MatrixXd right = R;
  lu.solve(right);
  x = right;
  return x.allFinite();
}

}  // namespace

TreadBody::TreadBody(const TreadSurface& tread,
                     const TreadLines& lines,
                     const PosedGround& ground,
                     double penalty,
                     const GroundMotion& motion,
                     const Eigen::Matrix3Xd& u,
                     double near)
    : motion_(motion), penalty_(penalty), hub_(ground.in_ground(Eigen::Vector3d::Zero())) {
  for (int k = 0; k < 3; ++k) R_.col(k) = ground.in_ground(Eigen::Vector3d::Unit(k)) - hub_;
  const Eigen::Matrix3Xd at = tread.points_at(tread.positions(u));
  const auto count = std::ssize(tread.points());
  Eigen::Matrix3Xd q(3, count);
  for (Eigen::Index k = 0; k < count; ++k) q.col(k) = ground.in_ground(at.col(k));
  const Eigen::VectorXd height = q.row(2).transpose();
  for (const std::vector<int>& line : lines.lines) add_line(tread, lines, line, height, near);
  // Points along the ground follow the mean itself: the offset stands for the arc that the ground
  // flattens, and would creep as it does.
  for (const int point : points_) {
    const Eigen::Vector3d offset = R_ * tread.points()[point].offset;
    x_0_.push_back(q.col(point) - Eigen::Vector3d(offset.x(), offset.y(), 0.0));
  }
  lines_.time = Eigen::Map<const Eigen::VectorXd>(times_.data(), std::ssize(times_));
  std::vector<int> column(3 * static_cast<std::size_t>(tread.nodes()), -1);
  for (std::size_t k = 0; k < rows_.size(); ++k) column[rows_[k]] = static_cast<int>(k);
  for (Section& section : sections_) {
    for (int& c : section.columns) c = column[c];
  }
}

/// Adds the part of a line that is near the ground, and the point before it.
void TreadBody::add_line(const TreadSurface& tread,
                         const TreadLines& lines,
                         const std::vector<int>& of,
                         const Eigen::VectorXd& height,
                         double near) {
  int first = -1, last = -1;
  for (int k = 0; k < std::ssize(of); ++k) {
    if (height[of[k]] >= near) continue;
    if (first < 0) first = k;
    last = k;
  }
  if (first < 0) return;
  first = std::max(0, first - 1);
  RollingLines::Line line{static_cast<int>(points_.size()), 0};
  Section section;
  std::map<int, int> local;  // row -> column
  for (int k = first; k <= last; ++k) {
    const TreadSurface::Point& point = tread.points()[of[k]];
    for (const int node : tread.nodes_of(point)) local.emplace(node, 0);
  }
  for (auto& [node, c] : local) {
    c = static_cast<int>(section.columns.size());
    for (int k = 0; k < 3; ++k) section.columns.push_back(3 * node + k);
  }
  section.P.setZero(3 * (last - first + 1), std::ssize(section.columns));
  for (int k = first; k <= last; ++k) {
    const TreadSurface::Point& point = tread.points()[of[k]];
    for (int w = 0; w < point.weights; ++w) {
      const TreadSurface::Weight& weight = tread.weights(point)[w];
      const TreadSurface::Place& place = tread.places()[weight.place];
      if (place.node < 0) continue;
      section.P.block<3, 3>(3 * (k - first), local[place.node]) += weight.w * R_ * place.T;
    }
    points_.push_back(of[k]);
    areas_.push_back(point.dA);
    times_.push_back(k == first ? 0.0
                                : (lines.theta[of[k - 1]] - lines.theta[of[k]]) / motion_.spin);
  }
  section.P_T = section.P.transpose();
  line.last = static_cast<int>(points_.size());
  lines_.lines.push_back(line);
  std::vector<int> rows = section.columns, all;
  std::ranges::set_union(rows_, rows, std::back_inserter(all));
  rows_ = std::move(all);
  sections_.push_back(std::move(section));
}

void TreadBody::set(Eigen::MatrixXd T, Eigen::VectorXd r) {
  T_ = std::move(T);
  r_ = std::move(r);
}

Eigen::Matrix3Xd TreadBody::positions(const Eigen::VectorXd& q) const {
  Eigen::Matrix3Xd x(3, std::ssize(points_));
  for (std::size_t s = 0; s < sections_.size(); ++s) {
    const RollingLines::Line& line = lines_.lines[s];
    const Eigen::VectorXd moved = sections_[s].P * q(sections_[s].columns);
    for (int k = line.first; k < line.last; ++k)
      x.col(k) = x_0_[k] + moved.segment<3>(3 * (k - line.first));
  }
  return x;
}

RollingInput TreadBody::input(const Eigen::VectorXd& q) const {
  const Eigen::Matrix3Xd x = positions(q);
  const Eigen::Index n = x.cols();
  RollingInput input{x.topRows<2>(),
                     (-penalty_ * x.row(2).transpose()).cwiseMax(0.0),
                     Eigen::VectorXd::Ones(n),
                     Eigen::Matrix2Xd(2, n)};
  for (Eigen::Index k = 0; k < n; ++k) {
    const Eigen::Vector2d from = x.col(k).head<2>() - hub_.head<2>();
    input.V_g.col(k) = motion_.velocity + motion_.turn * Eigen::Vector2d(-from.y(), from.x());
    if (k > 0 && x(2, k) < 0.0 && x(2, k - 1) >= 0.0)
      input.share[k] = x(2, k) / (x(2, k) - x(2, k - 1));
  }
  return input;
}

Eigen::VectorXd TreadBody::forces(const RollingInput& input, const GripTractions& tractions) const {
  Eigen::VectorXd sum = Eigen::VectorXd::Zero(std::ssize(rows_));
  for (std::size_t s = 0; s < sections_.size(); ++s) {
    const RollingLines::Line& line = lines_.lines[s];
    Eigen::VectorXd on(3 * (line.last - line.first));
    for (int k = line.first; k < line.last; ++k)
      on.segment<3>(3 * (k - line.first)) << tractions.t.col(k) * areas_[k], input.p[k] * areas_[k];
    sum(sections_[s].columns) += sections_[s].P.transpose() * on;
  }
  return sum;
}

Eigen::VectorXd TreadBody::residual(const Eigen::VectorXd& q,
                                    const RollingInput& input,
                                    const GripTractions& tractions) const {
  return T_ * q + r_ - forces(input, tractions);
}

/// Returns the derivatives of the forces on a line's points with respect to its columns [3 m x
/// columns].
Eigen::MatrixXd TreadBody::derivatives(const Section& section,
                                       const RollingLines::Line& line,
                                       const RollingInput& input,
                                       const GripTractions& tractions,
                                       const Eigen::Matrix3Xd& x) const {
  const int m = line.last - line.first;
  const auto columns = section.P.cols();
  Eigen::MatrixXd by = Eigen::MatrixXd::Zero(columns, 3 * m);  // transposed: a point is contiguous
  Eigen::MatrixXd before = Eigen::MatrixXd::Zero(columns, 2), now = before;
  for (int i = 0; i < m; ++i, before.swap(now)) {
    const int k = line.first + i;
    now.setZero();
    if (!(input.p[k] > 0.0)) continue;
    const GripLink& link = tractions.links[k];
    const auto at = section.P_T.middleCols<3>(3 * i);
    const Eigen::VectorXd dp = -penalty_ * at.col(2);
    now.noalias() = dp * link.by_p.transpose();
    if (i > 0) {
      const auto last = section.P_T.middleCols<3>(3 * i - 3);
      now.noalias() += (at.leftCols<2>() - last.leftCols<2>()) * link.by_step.transpose();
      now.noalias() += before * link.by_before.transpose();
      if (!(input.p[k - 1] > 0.0)) {
        const double here = x(2, k), there = x(2, k - 1), drop = here - there;
        const Eigen::VectorXd dshare = (here * last.col(2) - there * at.col(2)) / (drop * drop);
        now.noalias() += dshare * link.by_share.transpose();
      }
    }
    by.middleCols<2>(3 * i) = areas_[k] * now;
    by.col(3 * i + 2) = areas_[k] * dp;
  }
  return by;
}

bool TreadBody::solve(const Eigen::VectorXd& q,
                      const RollingInput& input,
                      const GripTractions& tractions,
                      const Eigen::VectorXd& R,
                      Eigen::VectorXd& dq) {
  Eigen::MatrixXd J = T_, tangent;
  const Eigen::Matrix3Xd x = positions(q);
  for (std::size_t s = 0; s < sections_.size(); ++s) {
    const RollingLines::Line& line = lines_.lines[s];
    const Section& section = sections_[s];
    const Eigen::MatrixXd by = derivatives(section, line, input, tractions, x).transpose();
    const int m = static_cast<int>(by.rows()), n = static_cast<int>(by.cols());
    tangent.setZero(n, n);
    numerics::subtract_transposed(n, n, m, section.P.data(), m, by.data(), tangent.data(), n);
    for (int b = 0; b < n; ++b) {
      double* column = J.col(section.columns[b]).data();
      for (int a = 0; a < n; ++a) column[section.columns[a]] += tangent(a, b);
    }
  }
  return solve_refined(J, R, dq);
}

}  // namespace latsch::fe_tire
