// SPDX-License-Identifier: Apache-2.0
// Typical identification problems: least squares over curves, transients, frequencies, frequency
// responses and hysteresis loops, with 2 to 15 variables between bounds, started from design values
// at some distance.
//
//   r_i(x) = model_i(x) - data_i,     data: the model at its truth and a small error
//
// There are two halves of similar problems. A method may be chosen by the tuning half
// (tuning_problems.cpp); the held-out half (held_out_problems.cpp) is evaluated once, after
// everything is decided. Both were written before any method was tried on them.
//
// Every problem comes in variants (disturbed_problem.h): smooth, rough, noisy, and with a corner of
// the space that fails.
#pragma once

#include <functional>
#include <string>
#include <vector>

#include "optimization/problem/design_space.h"

namespace latsch::identification_set {

using Vector = std::vector<double>;
using Residuals = std::function<Vector(const Vector& x)>;

struct Problem {
  std::string name;
  DesignSpace space;  // its initial point is the start
  Vector truth;       // inside the bounds, or outside if bounds are meant to be active
  Residuals residuals;
  bool is_held_out = false;

  int n() const { return space.size(); }
};

std::vector<Problem> tuning_problems();
std::vector<Problem> held_out_problems();
/// Problems with variables that are lost at the start (lost_problems.cpp); `is_held_out`: the
/// method was not decided by them.
std::vector<Problem> lost_problems();
/// Returns all problems, the tuning half first.
std::vector<Problem> problems();

// Helpers for defining problems -------------------------------------------------------------

/// A variable and its truth; logarithmic if the bounds are a factor of ten or more apart.
struct Number {
  const char* name;
  double lower, upper, start, truth;
};

using Model = std::function<Vector(const Vector& x)>;

/// Returns a problem whose data are the model's values at the truth, with errors of `error` times
/// their root mean square. Residuals are in units of that root mean square.
Problem fitted(const std::string& name,
               const std::vector<Number>& numbers,
               const Model& model,
               double error = 1e-3);

/// Returns `count` numbers from first to last.
Vector grid(double first, double last, int count);

/// Integrates y' = f(t, y) by the classical Runge-Kutta method with `steps` steps between two
/// times; returns y at each of the times.
using Rates = std::function<Vector(double t, const Vector& y)>;
std::vector<Vector> integrate(const Rates& f, Vector y, const Vector& times, int steps);

}  // namespace latsch::identification_set
