// SPDX-License-Identifier: Apache-2.0
#include "numerics/assignment.h"

#include <limits>

namespace latsch::numerics {
namespace {

/// Finds shortest augmenting paths on a cost matrix with no more rows than columns; every row gets
/// a column.
std::vector<int> assign_all_rows(const Eigen::MatrixXd& cost) {
  const int rows = static_cast<int>(cost.rows()), columns = static_cast<int>(cost.cols());
  Eigen::VectorXd u = Eigen::VectorXd::Zero(rows + 1),
                  v = Eigen::VectorXd::Zero(columns + 1);  // dual prices
  std::vector<int> row_of(columns + 1, 0),
      previous(columns + 1, 0);  // columns are counted from 1; column 0 is the root of a path
  for (int i = 1; i <= rows; ++i) {
    std::vector<double> distance(columns + 1, std::numeric_limits<double>::infinity());
    std::vector<char> reached(columns + 1, false);
    row_of[0] = i;
    int j = 0;
    do {  // Dijkstra's shortest path from row i to a free column
      reached[j] = true;
      int next = 0;
      double step = std::numeric_limits<double>::infinity();
      for (int k = 1; k <= columns; ++k) {
        if (reached[k]) continue;
        const double reduced = cost(row_of[j] - 1, k - 1) - u[row_of[j]] - v[k];
        if (reduced < distance[k]) {
          distance[k] = reduced;
          previous[k] = j;
        }
        if (distance[k] < step) {
          step = distance[k];
          next = k;
        }
      }
      for (int k = 0; k <= columns; ++k) {
        if (reached[k]) {
          u[row_of[k]] += step;
          v[k] -= step;
        } else {
          distance[k] -= step;
        }
      }
      j = next;
    } while (row_of[j] != 0);
    for (; j != 0; j = previous[j]) row_of[j] = row_of[previous[j]];
  }
  std::vector<int> partner(rows, -1);
  for (int k = 1; k <= columns; ++k) {
    if (row_of[k] > 0) partner[row_of[k] - 1] = k - 1;
  }
  return partner;
}

}  // namespace

std::vector<int> assign(const Eigen::MatrixXd& cost) {
  const Eigen::Index rows = cost.rows(), columns = cost.cols();
  if (rows == 0 || columns == 0) return std::vector<int>(rows, -1);
  double largest = 0.0;
  for (double c : cost.reshaped()) {
    if (c < kForbidden) largest = std::max(largest, std::abs(c));
  }
  // A forbidden pair costs more than any set of allowed pairs, so the assignment contains as few of
  // them as possible. They are removed from the result.
  const double forbidden = (2.0 * largest + 1.0) * static_cast<double>(std::min(rows, columns) + 1);
  Eigen::MatrixXd finite = cost.unaryExpr([&](double c) { return c < kForbidden ? c : forbidden; });
  std::vector<int> partner(rows, -1);
  if (rows <= columns) {
    partner = assign_all_rows(finite);
  } else {
    const std::vector<int> row_of = assign_all_rows(finite.transpose());
    for (int k = 0; k < static_cast<int>(columns); ++k) partner[row_of[k]] = k;
  }
  for (Eigen::Index i = 0; i < rows; ++i) {
    if (partner[i] >= 0 && cost(i, partner[i]) >= kForbidden) partner[i] = -1;
  }
  return partner;
}

}  // namespace latsch::numerics
