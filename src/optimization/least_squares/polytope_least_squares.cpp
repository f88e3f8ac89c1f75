// SPDX-License-Identifier: Apache-2.0
#include "optimization/least_squares/polytope_least_squares.h"

#include "optimization/least_squares/levenberg_descent.h"
#include "optimization/problem/quadratic_program.h"

namespace latsch {
namespace {

// Smallest curvature relative to the largest eigenvalue, because the quadratic program needs a
// positive definite matrix.
constexpr double kLeastPolytopeCurvature = 1e-10;

/// Scales the rows to length 1, so that rounding affects all rows alike.
void scale_rows(Eigen::MatrixXd& A, Eigen::VectorXd& b) {
  for (Eigen::Index i = 0; i < A.rows(); ++i) {
    const double length = A.row(i).norm();
    if (length == 0.0) continue;
    A.row(i) /= length;
    b[i] /= length;
  }
}

}  // namespace

Eigen::VectorXd minimize_in_polytope(const ResidualKriging& model,
                                     const Eigen::VectorXd& lower,
                                     const Eigen::VectorXd& upper,
                                     const Eigen::MatrixXd& E,
                                     const Eigen::MatrixXd& A,
                                     const Eigen::VectorXd& b) {
  const Eigen::Index n = lower.size(), rows = A.rows();
  QuadraticProgram qp;
  qp.E = E;
  qp.f = Eigen::VectorXd::Zero(E.rows());
  scale_rows(qp.E, qp.f);
  qp.A.resize(rows + 2 * n, n);
  qp.A << A, Eigen::MatrixXd::Identity(n, n), -Eigen::MatrixXd::Identity(n, n);
  Eigen::VectorXd room(rows + 2 * n);
  room << b, upper, -lower;
  room = room.cwiseMax(0.0);
  scale_rows(qp.A, room);
  return levenberg_descent(model,
                           n,
                           [&](const Eigen::VectorXd& z,
                               Eigen::MatrixXd H,
                               const Eigen::VectorXd& g) -> Eigen::VectorXd {
                             const double scale = H.diagonal().maxCoeff();
                             if (!std::isnormal(scale)) return z;
                             H.diagonal().array() += kLeastPolytopeCurvature * scale;
                             qp.G = H / scale;
                             qp.g = g / scale;
                             qp.b = (room - qp.A * z).cwiseMax(0.0);
                             const QuadraticSolution step = solve(qp);
                             return step.is_feasible() ? Eigen::VectorXd(z + step.x) : z;
                           });
}

}  // namespace latsch
