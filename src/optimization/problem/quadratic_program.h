// SPDX-License-Identifier: Apache-2.0
// Strictly convex quadratic programs, small and dense:
//
//   minimize 1/2 x'G x + g'x      with  E x = f  and  A x <= b
//
// The solver is the dual active-set method of Goldfarb and Idnani [Math. Programming 27 (1983) 1].
// It starts at the unconstrained minimum and adds one violated constraint after the other, the
// worst first. It needs no feasible start, and if there is no feasible point it reports constraints
// that contradict each other. Every step recomputes the factors with n^3 operations, so the solver
// suits up to about a hundred variables. Choose units in which rows of A and E have a length of
// about 1.
#pragma once

#include <Eigen/Core>
#include <vector>

namespace latsch {

struct QuadraticProgram {
  Eigen::MatrixXd G;  // n x n, positive definite
  Eigen::VectorXd g;
  Eigen::MatrixXd E;  // rows of the equations; may have no rows
  Eigen::VectorXd f;
  Eigen::MatrixXd A;  // rows of the inequalities; may have no rows
  Eigen::VectorXd b;
};

struct QuadraticSolution {
  Eigen::VectorXd x;
  /// Multipliers of the Lagrangian 1/2 x'G x + g'x + lambda'(E x - f) + mu'(A x - b),  mu >= 0.
  Eigen::VectorXd lambda, mu;
  /// Empty if x is the solution or if no solution was found. Otherwise it holds the indices of rows
  /// that no x fulfills together; rows of A are counted on after the rows of E.
  std::vector<int> contradiction;

  /// True if the method stopped at its limit of steps, because rounding errors made it cycle: x
  /// violates some constraints.
  bool is_out_of_steps = false;

  bool is_feasible() const { return contradiction.empty() && !is_out_of_steps; }
};

/// Solves the program. The limit of steps is `most_steps` times (number of constraints + 1).
QuadraticSolution solve(const QuadraticProgram& program, int most_steps = 100);

}  // namespace latsch
