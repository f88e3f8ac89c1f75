// SPDX-License-Identifier: Apache-2.0
#include "optimization/design/change_order.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numeric>

namespace latsch {
namespace {

constexpr int kMostOrderedExactly = 12;
// Weight of the distance that the settings move, which decides between orders of equal cost.
constexpr double kOfDistance = 1e-4;
// Settings that differ by less are equal.
constexpr double kSameSetting = 1e-9;

double change_cost(const Eigen::MatrixXd& tests, const std::vector<double>& costs, int a, int b) {
  double sum = 0.0;
  for (Eigen::Index k = 0; k < tests.cols(); ++k) {
    const double distance = std::abs(tests(a, k) - tests(b, k));
    if (distance <= kSameSetting) continue;
    sum += costs[static_cast<std::size_t>(k)] + kOfDistance * distance;
  }
  return sum;
}

/// Returns the cheapest order of few tests by the recursion of Held and Karp.
std::vector<int> cheapest_order(const Eigen::MatrixXd& D) {
  const int n = static_cast<int>(D.rows());
  const std::size_t sets = std::size_t{1} << n;
  std::vector<std::vector<double>> least(
      sets, std::vector<double>(static_cast<std::size_t>(n), std::numeric_limits<double>::max()));
  std::vector<std::vector<int>> before(sets, std::vector<int>(static_cast<std::size_t>(n), -1));
  for (int k = 0; k < n; ++k) least[std::size_t{1} << k][static_cast<std::size_t>(k)] = 0.0;
  for (std::size_t set = 1; set < sets; ++set)
    for (int last = 0; last < n; ++last) {
      const double cost = least[set][static_cast<std::size_t>(last)];
      if (cost == std::numeric_limits<double>::max()) continue;
      for (int next = 0; next < n; ++next) {
        const std::size_t bit = std::size_t{1} << next;
        if (set & bit) continue;
        double& reached = least[set | bit][static_cast<std::size_t>(next)];
        if (!(cost + D(last, next) < reached)) continue;
        reached = cost + D(last, next);
        before[set | bit][static_cast<std::size_t>(next)] = last;
      }
    }
  const auto& ends = least.back();
  int last = static_cast<int>(std::min_element(ends.begin(), ends.end()) - ends.begin());
  std::vector<int> order;
  for (std::size_t set = sets - 1; last >= 0;) {
    order.push_back(last);
    const int previous = before[set][static_cast<std::size_t>(last)];
    set &= ~(std::size_t{1} << last);
    last = previous;
  }
  std::reverse(order.begin(), order.end());
  return order;
}

double cost_of(const Eigen::MatrixXd& D, const std::vector<int>& order) {
  double sum = 0.0;
  for (std::size_t k = 1; k < order.size(); ++k) sum += D(order[k - 1], order[k]);
  return sum;
}

/// Improves an order by reversing parts of it and moving single tests until neither helps.
void improve_order(const Eigen::MatrixXd& D, std::vector<int>& order) {
  double least = cost_of(D, order);
  for (bool helps = true; helps;) {
    helps = false;
    for (std::size_t a = 0; a < order.size(); ++a)
      for (std::size_t b = 0; b < order.size(); ++b) {
        if (a == b) continue;
        for (const bool reverses : {true, false}) {
          std::vector<int> next = order;
          const auto from = next.begin() + static_cast<std::ptrdiff_t>(std::min(a, b));
          const auto to = next.begin() + static_cast<std::ptrdiff_t>(std::max(a, b)) + 1;
          if (reverses)
            std::reverse(from, to);
          else if (a < b)
            std::rotate(from, from + 1, to);
          else
            std::rotate(from, to - 1, to);
          const double cost = cost_of(D, next);
          if (!(cost < least * (1.0 - 1e-12))) continue;
          least = cost;
          order = std::move(next);
          helps = true;
        }
      }
  }
}

/// Returns the tests sorted by the dearest setting first.
std::vector<int> sorted_by_cost(const Eigen::MatrixXd& tests, const std::vector<double>& costs) {
  std::vector<Eigen::Index> dear(static_cast<std::size_t>(tests.cols()));
  std::iota(dear.begin(), dear.end(), Eigen::Index{0});
  std::stable_sort(dear.begin(), dear.end(), [&](Eigen::Index a, Eigen::Index b) {
    return costs[static_cast<std::size_t>(a)] > costs[static_cast<std::size_t>(b)];
  });
  std::vector<int> order(static_cast<std::size_t>(tests.rows()));
  std::iota(order.begin(), order.end(), 0);
  std::stable_sort(order.begin(), order.end(), [&](int a, int b) {
    for (const Eigen::Index k : dear)
      if (std::abs(tests(a, k) - tests(b, k)) > kSameSetting) return tests(a, k) < tests(b, k);
    return false;
  });
  return order;
}

}  // namespace

std::vector<int> order_of_few_changes(const Eigen::MatrixXd& tests,
                                      const std::vector<double>& costs) {
  const std::vector<int> sorted = sorted_by_cost(tests, costs);
  // equal tests are ordered as one
  std::vector<std::vector<int>> groups;
  for (const int k : sorted) {
    if (!groups.empty() &&
        (tests.row(k) - tests.row(groups.back().front())).lpNorm<Eigen::Infinity>() <= kSameSetting)
      groups.back().push_back(k);
    else
      groups.push_back({k});
  }
  const auto n = static_cast<Eigen::Index>(groups.size());
  Eigen::MatrixXd D(n, n);
  for (Eigen::Index a = 0; a < n; ++a)
    for (Eigen::Index b = 0; b < n; ++b)
      D(a, b) = change_cost(tests,
                            costs,
                            groups[static_cast<std::size_t>(a)].front(),
                            groups[static_cast<std::size_t>(b)].front());
  std::vector<int> order(groups.size());
  std::iota(order.begin(), order.end(), 0);
  if (n <= kMostOrderedExactly)
    order = cheapest_order(D);
  else
    improve_order(D, order);
  std::vector<int> all;
  for (const int group : order)
    for (const int k : groups[static_cast<std::size_t>(group)]) all.push_back(k);
  return all;
}

std::vector<int> setting_changes(const Eigen::MatrixXd& tests, const std::vector<int>& order) {
  std::vector<int> changes(static_cast<std::size_t>(tests.cols()), 0);
  for (std::size_t k = 1; k < order.size(); ++k)
    for (Eigen::Index i = 0; i < tests.cols(); ++i)
      if (std::abs(tests(order[k], i) - tests(order[k - 1], i)) > kSameSetting)
        ++changes[static_cast<std::size_t>(i)];
  return changes;
}

}  // namespace latsch
