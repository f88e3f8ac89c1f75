// SPDX-License-Identifier: Apache-2.0
#include "optimization/sqp/sqp_step.h"

#include <algorithm>
#include <limits>

#include "optimization/problem/quadratic_program.h"

namespace latsch {
namespace {

using Eigen::MatrixXd;
using Eigen::VectorXd;

// Length of a gradient below which a constraint is not scaled.
constexpr double kWithoutSlope = 1e-12;
// Smallest curvature of B relative to the largest.
constexpr double kLeastConvex = 1e-7;
// Cost of the relaxation t, relative to the steepest slope of the target.
constexpr double kRelaxed = 10.0;

/// Returns B with its curvatures limited to a range for which the program can be solved.
MatrixXd convex(const MatrixXd& B) {
  const double size = std::max(B.cwiseAbs().maxCoeff(), std::numeric_limits<double>::min());
  return B + kLeastConvex * size * MatrixXd::Identity(B.rows(), B.cols());
}

/// Collects constraints and their bounds as rows of a matrix; rows of constraints have length 1.
class Rows {
 public:
  explicit Rows(Eigen::Index columns) : A(0, columns), b(0) {}

  void add(const MatrixXd& rows, const VectorXd& bounds) {
    const auto at = A.rows();
    A.conservativeResize(at + rows.rows(), Eigen::NoChange);
    A.block(at, 0, rows.rows(), rows.cols()) = rows;
    A.block(at, rows.cols(), rows.rows(), A.cols() - rows.cols()).setZero();
    b.conservativeResize(at + rows.rows());
    b.tail(rows.rows()) = bounds;
  }

  MatrixXd A;
  VectorXd b;
};

VectorXd lengths(const MatrixXd& J) {
  VectorXd length = J.rowwise().norm();
  for (double& value : length) value = value > kWithoutSlope ? value : 1.0;
  return length;
}

/// The linearized constraints of the program. Columns after those of d belong to the relaxation t.
struct Linearized {
  VectorXd length_c, length_h;
  MatrixXd J_c, J_h;
  VectorXd c, h;

  Linearized(const SmoothValues& values, const SmoothSlopes& slopes)
      : length_c(lengths(slopes.c)), length_h(lengths(slopes.h)) {
    J_c = length_c.cwiseInverse().asDiagonal() * slopes.c;
    J_h = length_h.cwiseInverse().asDiagonal() * slopes.h;
    c = values.c.cwiseQuotient(length_c);
    h = values.h.cwiseQuotient(length_h);
  }
};

void add_box(Rows& rows, Eigen::Index n, double longest) {
  rows.add(MatrixXd::Identity(n, n), VectorXd::Constant(n, longest));
  rows.add(-MatrixXd::Identity(n, n), VectorXd::Constant(n, longest));
}

SqpStep relaxed(const MatrixXd& B,
                const VectorXd& g,
                const Linearized& linear,
                const FeasibleRegion& region,
                const VectorXd& u,
                double longest) {
  const auto n = u.size(), m_c = linear.c.size(), m_h = linear.h.size();
  const double price = kRelaxed * std::max(g.cwiseAbs().maxCoeff(), kWithoutSlope);
  QuadraticProgram qp;
  qp.G = MatrixXd::Zero(n + 1, n + 1);
  qp.G.topLeftCorner(n, n) = convex(B);
  qp.G(n, n) = price;
  qp.g = VectorXd::Constant(n + 1, price);
  qp.g.head(n) = g;
  Rows equal(n + 1), less(n + 1);
  equal.add(region.E(), region.f() - region.E() * u);
  less.add(linear.J_c, -linear.c);
  less.add(linear.J_h, -linear.h);
  less.add(-linear.J_h, linear.h);
  less.A.col(n).setConstant(-1.0);
  less.add(region.A(), region.b() - region.A() * u);
  add_box(less, n, longest);
  less.add(-VectorXd::Unit(n + 1, n).transpose(), VectorXd::Zero(1));
  qp.E = equal.A, qp.f = equal.b, qp.A = less.A, qp.b = less.b;
  const QuadraticSolution solution = solve(qp);
  const VectorXd& mu = solution.mu;
  return {solution.x.head(n),
          mu.head(m_c).cwiseQuotient(linear.length_c),
          (mu.segment(m_c, m_h) - mu.segment(m_c + m_h, m_h)).cwiseQuotient(linear.length_h)};
}

}  // namespace

SqpStep sqp_step(const MatrixXd& B,
                 const SmoothValues& values,
                 const SmoothSlopes& slopes,
                 const FeasibleRegion& region,
                 const VectorXd& u,
                 double longest) {
  const auto n = u.size();
  const Linearized linear(values, slopes);
  Rows equal(n), less(n);
  equal.add(linear.J_h, -linear.h);
  equal.add(region.E(), region.f() - region.E() * u);
  less.add(linear.J_c, -linear.c);
  less.add(region.A(), region.b() - region.A() * u);
  add_box(less, n, longest);
  const QuadraticSolution solution = solve({convex(B), slopes.g, equal.A, equal.b, less.A, less.b});
  if (!solution.is_feasible()) return relaxed(B, slopes.g, linear, region, u, longest);
  return {solution.x,
          solution.mu.head(linear.c.size()).cwiseQuotient(linear.length_c),
          solution.lambda.head(linear.h.size()).cwiseQuotient(linear.length_h)};
}

}  // namespace latsch
