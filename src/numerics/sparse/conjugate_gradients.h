// SPDX-License-Identifier: Apache-2.0
// Preconditioned conjugate gradients for A x = b with symmetric A and positive definite C near A.
// [Nocedal & Wright, Numerical Optimization, 2nd ed., algorithm 5.3 and the curvature test of 7.1]
#pragma once

#include <Eigen/Core>
#include <functional>

namespace latsch::numerics {

struct CgOutcome {
  enum class End { converged, iterations_spent, negative_curvature };
  End end = End::converged;
  int iterations = 0;     // number of products with A
  double residual = 0.0;  // norm of b - A x divided by that of b
};

class ConjugateGradients {
 public:
  using Operator = std::function<void(const Eigen::VectorXd& x, Eigen::VectorXd& y)>;  // y = A x
  using Preconditioner = std::function<void(Eigen::VectorXd& z)>;  // z <- C^-1 z

  explicit ConjugateGradients(int size);

  /// Starts from x = 0 and stops at |b - A x| <= tolerance |b|. If it meets negative curvature (p'
  /// A p <= 0), x is the last iterate before it or, in the first iteration, the preconditioned
  /// gradient C^-1 b; x is thus always a descent direction. If `foresees` is true, the solve also
  /// ends early when the convergence of its first iterations suggests that `max_iterations` will
  /// not suffice (later convergence is usually slower still); the outcome is then the same as if
  /// the iterations were spent.
  CgOutcome solve(const Operator& A,
                  const Preconditioner& C,
                  const Eigen::VectorXd& b,
                  double tolerance,
                  int max_iterations,
                  Eigen::VectorXd& x,
                  bool foresees = false);

 private:
  Eigen::VectorXd r_, z_, p_, Ap_;
};

}  // namespace latsch::numerics
