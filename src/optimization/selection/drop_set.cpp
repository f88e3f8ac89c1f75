// SPDX-License-Identifier: Apache-2.0
#include "optimization/selection/drop_set.h"

#include <algorithm>
#include <numeric>

#include "numerics/dense/cholesky.h"

namespace latsch {
namespace {

// Share of the units that is dropped at once at most. More would rest on slopes that belong to
// another model.
constexpr int kOneOf = 3;

}  // namespace

std::vector<double> single_rises(const Eigen::VectorXd& b,
                                 const Eigen::MatrixXd& C,
                                 const std::vector<std::vector<int>>& units) {
  std::vector<double> rises;
  for (const std::vector<int>& unit : units) {
    const Eigen::VectorXd own = b(unit);
    rises.push_back(own.dot(numerics::PivotedCholesky(C(unit, unit)).solve(own)));
  }
  return rises;
}

DropSet largest_drop_set(const Eigen::VectorXd& b,
                         const Eigen::MatrixXd& C,
                         const std::vector<std::vector<int>>& units,
                         double price) {
  DropSet best;
  if (units.empty()) return best;
  const std::vector<double> rises = single_rises(b, C, units);
  std::vector<int> order(units.size());
  std::iota(order.begin(), order.end(), 0);
  const auto each = [&](int unit) {
    const auto u = static_cast<std::size_t>(unit);
    return rises[u] / static_cast<double>(units[u].size());
  };
  std::stable_sort(order.begin(), order.end(), [&](int a, int c) { return each(a) < each(c); });
  order.resize(std::max<std::size_t>(1, units.size() / kOneOf));
  std::vector<int> coefficients;
  for (const int unit : order) {
    const auto& own = units[static_cast<std::size_t>(unit)];
    coefficients.insert(coefficients.end(), own.begin(), own.end());
  }
  best.units = {order.front()};
  best.rise = rises[static_cast<std::size_t>(order.front())];
  const numerics::Cholesky factors(C(coefficients, coefficients));
  if (!factors.is_positive_definite()) return best;
  const Eigen::VectorXd z = factors.solve_lower(Eigen::VectorXd(b(coefficients)));
  double rise = 0.0, least = 0.0;
  Eigen::Index count = 0;
  for (std::size_t j = 0; j < order.size(); ++j) {
    const auto own = std::ssize(units[static_cast<std::size_t>(order[j])]);
    rise += z.segment(count, own).squaredNorm();
    count += own;
    const bool below = rise < kRiseOfADrop * static_cast<double>(count);
    const double change = rise - price * static_cast<double>(count);
    if (!below && (best.stays_below || !(change < least))) continue;
    least = std::min(least, change);
    best = {{order.begin(), order.begin() + static_cast<std::ptrdiff_t>(j) + 1}, rise, below};
  }
  return best;
}

}  // namespace latsch
