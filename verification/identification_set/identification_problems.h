// SPDX-License-Identifier: Apache-2.0
// Typical identification problems: least-squares fits of curves, transients, frequencies, frequency
// responses and hysteresis loops, with 2 to 15 variables between bounds, started from design values
// at some distance.
//
//   r_i(x) = model_i(x) - data_i,     data: the model's values at the true x plus a small error
//
// There are two halves of similar problems. A method may be tuned on the tuning half
// (tuning_problems.cpp); the held-out half (held_out_problems.cpp) is evaluated once, after
// everything is decided. Both were written before any method was tried on them.
//
// Every problem comes in variants (disturbed_problem.h): smooth, rough, noisy, and with a corner of
// the design space in which every evaluation fails.
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
  DesignSpace space;  // its initial point is the start of the search
  /// true values: inside the bounds, or outside of them in problems with active bounds
  Vector truth;
  Residuals residuals;
  bool is_held_out = false;

  int n() const { return space.size(); }
};

std::vector<Problem> tuning_problems();
std::vector<Problem> held_out_problems();
/// Returns problems with variables that have no effect at the start (lost_problems.cpp).
/// `is_held_out` is true for those that were not used to design the method.
std::vector<Problem> lost_problems();
/// Returns problems with linear scales whose bounds lie far from the values (wide_problems.cpp).
std::vector<Problem> wide_problems();
/// Returns problems whose residuals leap, each from eight starts (leaping_problems.cpp).
std::vector<Problem> leaping_problems();
/// Returns all problems, the tuning half first.
std::vector<Problem> problems();

// Functions for defining problems --------------------------------------------------------------

/// A variable and its true value. Its scale is logarithmic if the bounds are a factor of ten or
/// more apart.
struct Number {
  const char* name;
  double lower, upper, start, truth;
};

using Model = std::function<Vector(const Vector& x)>;

/// Returns a problem whose data are the model's values at the true variables, with random errors of
/// `error` times the root mean square of these values. Residuals are in units of that root mean
/// square.
Problem fitted(const std::string& name,
               const std::vector<Number>& numbers,
               const Model& model,
               double error = 1e-3);

/// Returns `count` equidistant numbers from first to last.
Vector grid(double first, double last, int count);

/// Integrates y' = f(t, y) by the classical Runge-Kutta method with `steps` steps between two
/// neighboring times; returns y at each of the times.
using Rates = std::function<Vector(double t, const Vector& y)>;
std::vector<Vector> integrate(const Rates& f, Vector y, const Vector& times, int steps);

}  // namespace latsch::identification_set
