// SPDX-License-Identifier: Apache-2.0
// The 53 least-squares problems of Moré and Wild: f(x) = sum r_i(x)^2. They are 22 functions in
// several sizes (n variables, m residuals), each from its standard start x_s or from 10 x_s. A
// problem counts as solved to the tolerance tau at the first x with f(x) <= f_L + tau (f(x_0) -
// f_L). [Moré & Wild, Benchmarking derivative-free optimization algorithms, SIAM J. Optim. 20
// (2009) 172]
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
  std::string name;  // for example "Rosenbrock (2, 2) x 10": function, (n, m), factor on the start
  Vector start;      // x_0 = s x_s
  int residual_count;  // m
  double least;        // f_L
  std::function<Vector(const Vector&)> residuals;
  Vector steps = {};  // first step of every variable; empty: start_step for all
  /// derivatives of the residuals, n for each residual, one residual after the other; empty: not
  /// known
  std::function<Vector(const Vector&)> jacobian = {};

  int n() const { return static_cast<int>(start.size()); }
  double value(const Vector& x) const;
  /// Returns f_L + tau (f(x_0) - f_L).
  double solved_below(double tau) const;
};

/// Returns the problems in the order of the paper's table.
const std::vector<Problem>& problems();

/// Returns the length of the first step that every solver uses: max(1, |x_0|_inf).
double start_step(const Problem& problem);
/// Returns the length of the first step for each variable.
Vector start_steps(const Problem& problem);

/// Width of the bounds in units of start_step(). The problems have no bounds but a design space
/// needs them: they are x_0 -+ half this width, so wide that no solver comes near them, yet narrow
/// enough to resolve 1e-12 of a first step.
inline constexpr double kBoxWidth = 2e3;
DesignSpace space(const Problem& problem);

}  // namespace latsch::more_wild
