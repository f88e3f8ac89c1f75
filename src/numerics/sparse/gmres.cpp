// SPDX-License-Identifier: Apache-2.0
#include "numerics/sparse/gmres.h"

#include <cmath>
#include <vector>

namespace latsch::numerics {
namespace {

/// A rotation of two successive rows.
struct Rotation {
  double c, s;
  void turn(double& a, double& b) const {
    const double first = c * a + s * b;
    b = c * b - s * a;
    a = first;
  }
};

}  // namespace

CgOutcome gmres(const ConjugateGradients::Operator& A,
                const ConjugateGradients::Preconditioner& C,
                const Eigen::VectorXd& b,
                double tolerance,
                int max_iterations,
                Eigen::VectorXd& x) {
  CgOutcome outcome;
  const double b_norm = b.norm();
  x.setZero(b.size());
  if (b_norm == 0.0) return outcome;
  outcome.residual = 1.0;
  Eigen::MatrixXd V(b.size(), max_iterations + 1), Z(b.size(), max_iterations);
  Eigen::MatrixXd R = Eigen::MatrixXd::Zero(max_iterations + 1, max_iterations);
  Eigen::VectorXd g = Eigen::VectorXd::Zero(max_iterations + 1), z(b.size()), w(b.size());
  std::vector<Rotation> rotations;
  V.col(0) = b / b_norm;
  g[0] = b_norm;
  int j = 0;
  while (outcome.residual > tolerance && j < max_iterations) {
    z = V.col(j);
    C(z);
    Z.col(j) = z;
    A(z, w);
    for (int i = 0; i <= j; ++i) {
      R(i, j) = V.col(i).dot(w);
      w -= R(i, j) * V.col(i);
    }
    R(j + 1, j) = w.norm();
    if (R(j + 1, j) > 0.0) V.col(j + 1) = w / R(j + 1, j);
    for (int i = 0; i < j; ++i) rotations[i].turn(R(i, j), R(i + 1, j));
    const double length = std::hypot(R(j, j), R(j + 1, j));
    if (!(length > 0.0)) break;  // A z lies in the space already
    rotations.push_back({R(j, j) / length, R(j + 1, j) / length});
    rotations.back().turn(R(j, j), R(j + 1, j));
    rotations.back().turn(g[j], g[j + 1]);
    ++j;
    outcome.residual = std::abs(g[j]) / b_norm;
  }
  outcome.iterations = j;
  if (!(outcome.residual <= tolerance)) outcome.end = CgOutcome::End::iterations_spent;
  if (j == 0) return outcome;
  const Eigen::VectorXd y = R.topLeftCorner(j, j).triangularView<Eigen::Upper>().solve(g.head(j));
  x = Z.leftCols(j) * y;
  return outcome;
}

}  // namespace latsch::numerics
