// SPDX-License-Identifier: Apache-2.0
// Strictly convex quadratic programs, small and dense:
//
//   minimize 1/2 x'G x + g'x      with  E x = f  and  A x <= b
//
// The solver is the dual active-set method of Goldfarb and Idnani [Math. Programming 27 (1983) 1].
// It starts at the unconstrained minimum and adds one violated constraint after the other, the
// worst first. It needs no feasible start, and if there is no feasible point it reports constraints
// that contradict each other. Every step recomputes the factors with n^3 operations, so it suits up
// to about a hundred variables. Choose units in which rows of A and E have a length of about 1.
#pragma once

#include <Eigen/Core>
#include <vector>

namespace latsch {

struct QuadraticProgram {
  Eigen::MatrixXd G;  // n x n, positive definite
  Eigen::VectorXd g;
  Eigen::MatrixXd E;  // no rows: no equations
  Eigen::VectorXd f;
  Eigen::MatrixXd A;  // no rows: no inequalities
  Eigen::VectorXd b;
};

struct QuadraticSolution {
  Eigen::VectorXd x;
  /// Multipliers of the Lagrangian 1/2 x'G x + g'x + lambda'(E x - f) + mu'(A x - b),  mu >= 0.
  Eigen::VectorXd lambda, mu;
  /// Empty if x is the solution or none was found; otherwise indices of rows of E, continued by
  /// rows of A, that no x fulfills together.
  std::vector<int> contradiction;

  /// True if rounding made the method cycle until its steps were used up: x violates some
  /// constraints.
  bool is_out_of_steps = false;

  bool is_feasible() const { return contradiction.empty() && !is_out_of_steps; }
};

/// `most_steps` is the limit for each constraint, plus the same number once more.
QuadraticSolution solve(const QuadraticProgram& program, int most_steps = 100);

}  // namespace latsch
