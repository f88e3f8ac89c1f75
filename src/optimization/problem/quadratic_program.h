// SPDX-License-Identifier: Apache-2.0
// Strictly convex quadratic programs, small and dense:
//
//   least 1/2 x'G x + g'x      with  E x = f  and  A x <= b
//
// by the dual active-set method of Goldfarb and Idnani [Math. Programming 27 (1983) 1]: it starts
// at the unconstrained minimum and takes in one violated constraint after the other, the worst
// first. It needs no feasible start, and where there is no feasible point it ends with constraints
// that contradict each other. The factors are made anew in every step, n^3 operations: for up to
// about a hundred variables. Choose units in which rows of A and E have a length of about 1.
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
  /// Of the Lagrangian 1/2 x'G x + g'x + lambda'(E x - f) + mu'(A x - b),  mu >= 0.
  Eigen::VectorXd lambda, mu;
  /// Empty where x is the solution or none was found; else rows of E, then of A, counted on, that
  /// no x fulfills together.
  std::vector<int> contradiction;

  /// Rounding made it turn in circles until it was out of steps: x fulfills not all constraints.
  bool is_out_of_steps = false;

  bool is_feasible() const { return contradiction.empty() && !is_out_of_steps; }
};

/// `most_steps`: for every constraint and one more.
QuadraticSolution solve(const QuadraticProgram& program, int most_steps = 100);

}  // namespace latsch
