// SPDX-License-Identifier: Apache-2.0
#include "optimization/least_squares/box_least_squares.h"

#include <algorithm>
#include <vector>

#include "numerics/dense/cholesky.h"
#include "optimization/least_squares/levenberg_descent.h"

namespace latsch {
namespace {

/// The room of a step, and the variables that are held.
struct Room {
  Eigen::VectorXd lower, upper;  // of the step
  std::vector<bool> is_held;
};

Room room_at(const Eigen::VectorXd& z,
             const Eigen::VectorXd& g,
             const Eigen::VectorXd& lower,
             const Eigen::VectorXd& upper) {
  Room room{lower - z, upper - z, std::vector<bool>(z.size())};
  for (Eigen::Index i = 0; i < z.size(); ++i) {
    room.is_held[i] = (z[i] <= lower[i] && g[i] > 0.0) || (z[i] >= upper[i] && g[i] < 0.0);
  }
  return room;
}

/// A p = -g for the free variables with the others at their part of p.
Eigen::VectorXd solve_free(Eigen::MatrixXd A,
                           const Eigen::VectorXd& g,
                           const Eigen::VectorXd& p,
                           const std::vector<bool>& is_held) {
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
  return numerics::PivotedCholesky(A).solve(b);
}

/// The step with matrix A, variables that would leave the room held at its face.
Eigen::VectorXd step_in(Room room, const Eigen::MatrixXd& A, const Eigen::VectorXd& g) {
  Eigen::VectorXd p = Eigen::VectorXd::Zero(g.size());
  for (Eigen::Index pass = 0; pass <= g.size(); ++pass) {
    p = solve_free(A, g, p, room.is_held);
    bool is_inside = true;
    for (Eigen::Index i = 0; i < g.size(); ++i) {
      const double inside = std::clamp(p[i], room.lower[i], room.upper[i]);
      if (room.is_held[i] || inside == p[i]) continue;
      p[i] = inside;
      room.is_held[i] = true;
      is_inside = false;
    }
    if (is_inside) break;
  }
  return p;
}

}  // namespace

Eigen::VectorXd minimize_in_box(const ResidualKriging& model,
                                const Eigen::VectorXd& lower,
                                const Eigen::VectorXd& upper) {
  return levenberg_descent(
      model,
      lower.size(),
      [&](const Eigen::VectorXd& z, const Eigen::MatrixXd& A, const Eigen::VectorXd& g) {
        const Eigen::VectorXd p = step_in(room_at(z, g, lower, upper), A, g);
        return Eigen::VectorXd((z + p).cwiseMax(lower).cwiseMin(upper));
      });
}

}  // namespace latsch
