// SPDX-License-Identifier: Apache-2.0
#include "models/fe_tire/passage/tread_flexibility.h"

#include <algorithm>
#include <cmath>
#include <utility>

#include "numerics/sparse/front_algebra.h"

namespace latsch::fe_tire {
namespace {

/// Depth to which the lowest point is pressed if none touches and a load is asked for, m.
constexpr double kPressedFirst = 1e-5;
/// Largest rise in a step of Newton's method, m.
constexpr double kHighestRise = 2e-3;

}  // namespace

FlexibleTread::FlexibleTread(TreadBody& body,
                             const Eigen::MatrixXf& F,
                             const Eigen::VectorXd& g,
                             std::optional<double> load)
    : body_(body), F_(F), g_(g), load_(load) {
  up_ = body.to_nodes(Eigen::Vector3d::UnitZ().replicate(size() / 3, 1));
  std::vector<int> others;
  Eigen::VectorXd forces(g.size());
  std::size_t next = 0;
  for (int row = 0; row < F.rows(); ++row) {
    if (next < body.rows().size() && body.rows()[next] == row) {
      ++next;
    } else {
      forces[std::ssize(others)] = -g[row];
      others.push_back(row);
    }
  }
  beyond_ = by_forces(others, forces.head(std::ssize(others)));
}

Eigen::VectorXd FlexibleTread::start() const {
  Eigen::VectorXd f(size() + (load_ ? 1 : 0));
  f.head(size()) = g_(body_.rows());
  if (!load_) return f;
  f[size()] = 0.0;
  const double lowest = body_.positions(moved_rows(f)).row(2).minCoeff();
  if (!(lowest < 0.0)) f[size()] = -(lowest + kPressedFirst);
  return f;
}

/// Returns the sum of forces on some rows along the ground's z.
double FlexibleTread::along_z(const std::vector<int>& rows, const Eigen::VectorXd& forces) const {
  return Eigen::VectorXd(up_(rows)).dot(forces);
}

/// Returns the displacements of all nodes by forces on some rows.
Eigen::VectorXd FlexibleTread::by_forces(const std::vector<int>& rows,
                                         const Eigen::VectorXd& forces) const {
  const int m = static_cast<int>(F_.rows());
  Eigen::VectorXf sum = Eigen::VectorXf::Zero(m);
  Eigen::VectorXf part(m);
  // Successive columns that carry forces are multiplied at once.
  const auto carries = [&](std::size_t k) { return forces[static_cast<Eigen::Index>(k)] != 0.0; };
  for (std::size_t first = 0, last; first < rows.size(); first = last) {
    last = first + 1;
    if (!carries(first)) continue;
    while (last < rows.size() && rows[last] == rows[last - 1] + 1 && carries(last)) ++last;
    const int count = static_cast<int>(last - first);
    const Eigen::VectorXf by =
        forces.segment(static_cast<Eigen::Index>(first), count).cast<float>();
    numerics::multiply(m, 1, count, F_.col(rows[first]).data(), m, by.data(), count, part.data());
    sum += part;
  }
  return sum.cast<double>();
}

Eigen::VectorXd FlexibleTread::moved(const Eigen::VectorXd& f) const {
  return beyond_ + by_forces(body_.rows(), f.head(size()) - Eigen::VectorXd(g_(body_.rows())));
}

Eigen::VectorXd FlexibleTread::moved_rows(const Eigen::VectorXd& f) const {
  Eigen::VectorXd q = body_.to_ground(Eigen::VectorXd(moved(f)(body_.rows())));
  for (Eigen::Index row = 2; row < q.size(); row += 3) q[row] += rise(f);
  return q;
}

RollingInput FlexibleTread::input(const Eigen::VectorXd& f) const {
  return body_.input(moved_rows(f));
}

Eigen::VectorXd FlexibleTread::residual(const Eigen::VectorXd& f,
                                        const RollingInput& input,
                                        const GripTractions& tractions) const {
  const Eigen::VectorXd c = body_.forces(input, tractions);
  Eigen::VectorXd R(f.size());
  R.head(size()) = f.head(size()) - c;
  if (load_) R[size()] = up_.dot(c) - *load_;
  return R;
}

/// Solves (1 - C F) df - C up dr = R on the rows, and up' (C F df + C up dr) = R behind them. On
/// rows without a part of C, df = R.
bool FlexibleTread::solve(const Eigen::VectorXd& f,
                          const RollingInput& input,
                          const GripTractions& tractions,
                          const Eigen::VectorXd& R,
                          Eigen::VectorXd& df) {
  df = R;
  const std::vector<TreadBody::Part> parts = body_.by_nodes(moved_rows(f), input, tractions);
  // Active rows in the order of the parts, which go across the tread: C is then a band.
  std::vector<int> place(body_.rows().size(), -1);  // a row's place among the active ones
  std::vector<int> active, columns;                 // rows of the body, and of F
  for (const TreadBody::Part& part : parts)
    for (const int row : part.rows) {
      if (place[row] >= 0) continue;
      place[row] = static_cast<int>(active.size());
      active.push_back(row);
      columns.push_back(body_.rows()[row]);
    }
  if (active.empty()) return !load_;
  const int n = static_cast<int>(active.size());
  Eigen::MatrixXf C = Eigen::MatrixXf::Zero(n, n);
  std::vector<std::pair<int, int>> reach(active.size(), {n, 0});  // columns of each row of C
  for (const TreadBody::Part& part : parts) {
    std::vector<int> places;
    for (const int row : part.rows) places.push_back(place[row]);
    const auto [least, most] = std::ranges::minmax(places);
    for (std::size_t k = 0; k < places.size(); ++k) {
      auto& [first, last] = reach[places[k]];
      first = std::min(first, least);
      last = std::max(last, most + 1);
      for (std::size_t i = 0; i < places.size(); ++i)
        C(places[i], places[k]) +=
            static_cast<float>(part.C(static_cast<Eigen::Index>(i), static_cast<Eigen::Index>(k)));
    }
  }
  Eigen::MatrixXf F(n, n), J(n, n), product;
  for (int k = 0; k < n; ++k) {
    const float* of = F_.col(columns[k]).data();
    for (int i = 0; i < n; ++i) F(i, k) = of[columns[i]];
  }
  for (int first = 0, last = 0; first < n; first = last) {
    while (last < n && reach[last] == reach[first]) ++last;
    const auto [from, to] = reach[first];
    const int rows = last - first;
    product.resize(rows, n);
    numerics::multiply(rows, n, to - from, &C(first, from), n, &F(from, 0), n, product.data());
    J.middleRows(first, rows) = -product;
  }
  J.diagonal().array() += 1.0F;
  // Forces of nodes that have come off the ground vanish at once, which moves the others.
  Eigen::VectorXd others = R.head(size());
  others(active).setZero();
  const Eigen::VectorXd by_others = by_forces(body_.rows(), others);
  Eigen::VectorXd r = R(active), lifted = Eigen::VectorXd::Zero(n);
  for (const TreadBody::Part& part : parts) {
    std::vector<int> rows, places;
    for (const int row : part.rows) {
      rows.push_back(body_.rows()[row]);
      places.push_back(place[row]);
    }
    r(places) += part.C * Eigen::VectorXd(by_others(rows));
    if (load_) lifted(places) += part.C * Eigen::VectorXd(up_(part.rows));
  }
  std::vector<int> order(active.size());
  numerics::factorize_lu(n, J.data(), order.data());
  const auto solved = [&](const Eigen::VectorXd& by) -> Eigen::VectorXd {
    const double largest = by.cwiseAbs().maxCoeff();
    if (!(largest > 0.0)) return Eigen::VectorXd::Zero(n);
    Eigen::VectorXf x = (by / largest).cast<float>();
    numerics::solve_lu(n, J.data(), order.data(), x.data());
    return largest * x.cast<double>();
  };
  Eigen::VectorXd x = solved(r);
  double share = 1.0;
  if (load_) {
    // C F x is x - R, and C F y + C up is y, where y is what a rise changes.
    const Eigen::VectorXd y = solved(lifted);
    const double by_rise = along_z(active, y);
    if (by_rise == 0.0) return false;
    df[size()] = (R[size()] - along_z(active, x - R(active))) / by_rise;
    x += df[size()] * y;
    share = std::min(1.0, kHighestRise / std::abs(df[size()]));
  }
  df(active) = x;
  if (share < 1.0) df *= share;
  return df.allFinite();
}

}  // namespace latsch::fe_tire
