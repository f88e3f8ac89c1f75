// SPDX-License-Identifier: Apache-2.0
// The 53 least-squares problems of Moré and Wild:  f(x) = sum r_i(x)^2,  started at  s x_s.
//
// 22 functions in several sizes n, m, each from its standard start x_s or from 10 x_s. A problem
// counts as solved to tau at the first x with  f(x) <= f_L + tau (f(x_0) - f_L).
// [Moré & Wild, Benchmarking derivative-free optimization algorithms, SIAM J. Optim. 20 (2009) 172]
//
// f_L is the least value known in the neighborhood of the start, zero if the residuals can vanish.
// The function of Freudenstein and Roth has two minima, 0 and 48.98; descent from either start
// leads to the second, which is its f_L, as in the tables of published solvers.
#pragma once

#include <functional>
#include <string>
#include <vector>

#include "optimization/problem/design_space.h"

namespace latsch::more_wild {

using Vector = std::vector<double>;

struct Problem {
  std::string name;    // "Rosenbrock (2, 2) x 10": function, (n, m), factor of the start
  Vector start;        // x_0 = s x_s
  int residual_count;  // m
  double least;        // f_L
  std::function<Vector(const Vector&)> residuals;
  Vector steps = {};  // first step of every variable; empty: start_step for all
  std::function<Vector(const Vector&)> jacobian = {};  // n a residual; empty: not known

  int n() const { return static_cast<int>(start.size()); }
  double value(const Vector& x) const;
  /// Returns f_L + tau (f(x_0) - f_L).
  double solved_below(double tau) const;
};

/// Problems in the order of the paper's table.
const std::vector<Problem>& problems();

/// Returns the step every solver starts with: max(1, |x_0|_inf).
double start_step(const Problem& problem);
/// Returns the first step of every variable.
Vector start_steps(const Problem& problem);

/// The problems have no bounds but a design space needs them: the box, x_0 -+ kBoxWidth / 2 start
/// steps, is so wide that no iterate comes near its faces, yet 1e-12 of a start step is resolved.
inline constexpr double kBoxWidth = 2e3;
DesignSpace space(const Problem& problem);

}  // namespace latsch::more_wild
