// SPDX-License-Identifier: Apache-2.0
#include "optimization/box_least_squares.h"

#include <Eigen/Cholesky>
#include <algorithm>
#include <limits>
#include <vector>

namespace latsch {
namespace {

constexpr int kMostIterations = 60;
constexpr double kLeastDecrease = 1e-9;  // of the value, in one iteration: the end
constexpr double kFirstDamping = 1e-6;   // mu, of the largest diagonal of J'J
constexpr double kLeastDamping = 1e-12;
constexpr double kMostDamping = 1e12;

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
  return A.ldlt().solve(b);
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

Eigen::VectorXd minimize_in_box(const ResidualModel& model,
                                const Eigen::VectorXd& lower,
                                const Eigen::VectorXd& upper) {
  Eigen::VectorXd z = Eigen::VectorXd::Zero(lower.size());
  double value = model.expected(z);
  double damping = kFirstDamping;
  for (int k = 0; k < kMostIterations && damping < kMostDamping;) {
    const Eigen::MatrixXd J = model.jacobian(z);
    const Eigen::VectorXd g = J.transpose() * model.residuals(z) + model.variance_gradient(z);
    const Eigen::MatrixXd H = J.transpose() * J + model.variance_hessian(z);
    const double scale = std::max(H.diagonal().maxCoeff(), std::numeric_limits<double>::min());
    const Room room = room_at(z, g, lower, upper);
    for (bool descends = false; !descends && damping < kMostDamping; ++k) {
      Eigen::MatrixXd A = H;
      A.diagonal().array() += damping * scale;
      const Eigen::VectorXd next = (z + step_in(room, A, g)).cwiseMax(lower).cwiseMin(upper);
      const double value_next = model.expected(next);
      descends = value_next < value;
      damping = descends ? std::max(1e-2 * damping, kLeastDamping) : 10.0 * damping;
      if (!descends) continue;
      const bool is_end = value_next > (1.0 - kLeastDecrease) * value;
      z = next;
      value = value_next;
      if (is_end) return z;
    }
  }
  return z;
}

}  // namespace latsch
