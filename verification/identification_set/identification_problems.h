// SPDX-License-Identifier: Apache-2.0
// Problems as identification meets them: least squares over curves, transients, frequencies,
// frequency responses and hysteresis loops, 2 to 15 variables between bounds, started from design
// values some way off.
//
//   r_i(x) = model_i(x) - data_i,     data: the model at its truth and a small error
//
// Two halves of like kind. The tuning half (tuning_problems.cpp) is what a method may be chosen by;
// the held-out half (held_out_problems.cpp) is for looking at once, when everything is decided.
// Both were written down before a method was tried on either.
//
// Every problem comes in variants (Disturbance in identification_runs.h): smooth, rough, noisy, and
// with a corner of the space that fails.
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
  Vector truth;       // inside the bounds, or outside where bounds are to be active
  Residuals residuals;
  bool is_held_out = false;

  int n() const { return space.size(); }
};

std::vector<Problem> tuning_problems();
std::vector<Problem> held_out_problems();
/// With variables that are lost at the start (lost_problems.cpp); `is_held_out`: not decided by.
std::vector<Problem> lost_problems();
/// The tuning half first.
std::vector<Problem> problems();

// How they are written down -----------------------------------------------------------------

/// A variable and its truth; logarithmic where the bounds are a factor of ten or more apart.
struct Number {
  const char* name;
  double lower, upper, start, truth;
};

using Model = std::function<Vector(const Vector& x)>;

/// The model's values at the truth, with errors of `error` times their root mean square, are the
/// data; residuals are in units of that root mean square.
Problem fitted(const std::string& name,
               const std::vector<Number>& numbers,
               const Model& model,
               double error = 1e-3);

/// `count` numbers from first to last.
Vector grid(double first, double last, int count);

/// y' = f(t, y) by the classical Runge-Kutta method with `steps` steps between two times; y at each
/// of them.
using Rates = std::function<Vector(double t, const Vector& y)>;
std::vector<Vector> integrate(const Rates& f, Vector y, const Vector& times, int steps);

}  // namespace latsch::identification_set
