// SPDX-License-Identifier: Apache-2.0
#include "optimization/identifiability/reduced_rows.h"

#include <algorithm>
#include <cassert>

#include "numerics/dense/orthogonal_factors.h"

namespace latsch {
namespace {

Eigen::Index reduced_count(const std::vector<Eigen::Index>& group, Eigen::Index n) {
  return std::min<Eigen::Index>(std::ssize(group), n + 1);
}

}  // namespace

Evaluated reduced_rows(const Evaluated& whole, const RowGroups& groups) {
  assert(whole.has_slopes());
  const Eigen::Index n = whole.J.cols();
  Eigen::Index rows = 0;
  for (const auto& group : groups) rows += reduced_count(group, n);
  Evaluated reduced(Eigen::VectorXd(rows), Eigen::MatrixXd(rows, n));
  reduced.is_reduced = true;
  Eigen::Index first = 0;
  for (const auto& group : groups) {
    const Eigen::Index count = reduced_count(group, n);
    Eigen::MatrixXd A(std::ssize(group), n + 1);
    A << whole.J(group, Eigen::all), whole.r(group);
    if (A.rows() > n + 1) A = numerics::HouseholderQr(A).R();
    reduced.J.middleRows(first, count) = A.leftCols(n);
    reduced.r.segment(first, count) = A.col(n);
    first += count;
  }
  return reduced;
}

std::vector<int> groups_of_reduced_rows(const RowGroups& groups, Eigen::Index n) {
  std::vector<int> group_of_row;
  for (std::size_t g = 0; g < groups.size(); ++g)
    group_of_row.insert(group_of_row.end(), reduced_count(groups[g], n), static_cast<int>(g));
  return group_of_row;
}

}  // namespace latsch
