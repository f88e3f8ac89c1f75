// SPDX-License-Identifier: Apache-2.0
#include "optimization/least_squares/box_least_squares.h"

#include <vector>

#include "numerics/dense/cholesky.h"
#include "optimization/least_squares/levenberg_descent.h"
#include "optimization/least_squares/step_in_box.h"

namespace latsch {
namespace {

/// Solves A p = -g for the free variables, with the others fixed at their components of p.
Eigen::VectorXd solve_free(Eigen::MatrixXd A,
                           const Eigen::VectorXd& g,
                           const Eigen::VectorXd& p,
                           const std::vector<int>& free) {
  std::vector<bool> is_held(static_cast<std::size_t>(p.size()), true);
  for (const int i : free) is_held[i] = false;
  Eigen::VectorXd b = -g;
  for (Eigen::Index i = 0; i < p.size(); ++i) {
    if (is_held[i]) b -= A.col(i) * p[i];
  }
  for (Eigen::Index i = 0; i < p.size(); ++i) {
    if (!is_held[i]) continue;
    A.row(i).setZero();
    A.col(i).setZero();
    A(i, i) = 1.0;
    b[i] = p[i];
  }
  return numerics::PivotedCholesky(A).solve(b)(free);
}

}  // namespace

Eigen::VectorXd minimize_in_box(const ResidualKriging& model,
                                const Eigen::VectorXd& lower,
                                const Eigen::VectorXd& upper) {
  return levenberg_descent(
      model,
      lower.size(),
      [&](const Eigen::VectorXd& z, const Eigen::MatrixXd& A, const Eigen::VectorXd& g) {
        const auto step = [&](const Eigen::VectorXd& p, const std::vector<int>& free) {
          return solve_free(A, g, p, free);
        };
        const Eigen::VectorXd p =
            step_in_box(lower - z, upper - z, free_in_box(z, g, lower, upper), step);
        return Eigen::VectorXd((z + p).cwiseMax(lower).cwiseMin(upper));
      });
}

}  // namespace latsch
