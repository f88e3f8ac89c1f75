// SPDX-License-Identifier: Apache-2.0
#include "models/fe_tire/description/section_grid.h"

#include <algorithm>
#include <cassert>

namespace latsch::fe_tire {
namespace {

/// Returns the index of the first of the four points around x, or 0 if there are fewer than four.
std::ptrdiff_t first_of_four(const std::vector<double>& points, double x) {
  const auto next = std::ranges::upper_bound(points, x) - points.begin();
  return std::clamp<std::ptrdiff_t>(
      next - 2, 0, std::max<std::ptrdiff_t>(0, std::ssize(points) - 4));
}

/// Returns, at x, the Lagrange polynomial of point k among the `count` points from `first` on.
double factor(const std::vector<double>& points,
              std::ptrdiff_t first,
              std::ptrdiff_t count,
              std::ptrdiff_t k,
              double x) {
  double product = 1.0;
  for (std::ptrdiff_t i = first; i < first + count; ++i) {
    if (i != k) product *= (x - points[i]) / (points[k] - points[i]);
  }
  return product;
}

/// Interpolates through the wall, at the height `row`, between the nodes of a station; `first` is
/// the first of them.
Eigen::Vector3d at_row(const std::vector<double>& rows,
                       Eigen::Index first,
                       double row,
                       const Eigen::Matrix3Xd& u) {
  const auto next = std::clamp<std::ptrdiff_t>(
      std::ranges::upper_bound(rows, row) - rows.begin(), 1, std::ssize(rows) - 1);
  const double part = (row - rows[next - 1]) / (rows[next] - rows[next - 1]);
  return (1.0 - part) * u.col(first + next - 1) + part * u.col(first + next);
}

}  // namespace

int SectionGrid::nodes() const {
  int count = 0;
  for (const auto& station : rows) count += static_cast<int>(station.size());
  return count;
}

Eigen::Matrix3Xd on_grid(const SectionGrid& to,
                         const SectionGrid& from,
                         const Eigen::Matrix3Xd& u) {
  std::vector<Eigen::Index> first = {0};
  for (const auto& rows : from.rows) first.push_back(first.back() + std::ssize(rows));
  assert(first.back() == u.cols());
  const auto count = std::min<std::ptrdiff_t>(4, std::ssize(from.stations));
  Eigen::Matrix3Xd found = Eigen::Matrix3Xd::Zero(3, to.nodes());
  Eigen::Index node = 0;
  for (std::size_t i = 0; i < to.stations.size(); ++i) {
    const double s = to.stations[i];
    const auto begin = first_of_four(from.stations, s);
    for (const double row : to.rows[i]) {
      for (auto k = begin; k < begin + count; ++k) {
        found.col(node) +=
            factor(from.stations, begin, count, k, s) * at_row(from.rows[k], first[k], row, u);
      }
      ++node;
    }
  }
  return found;
}

}  // namespace latsch::fe_tire
