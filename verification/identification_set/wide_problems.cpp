// SPDX-License-Identifier: Apache-2.0
// Problems whose bounds lie far from the values: every variable has a linear scale, and the true
// values lie at 0.4 to 3 % of the ranges. A tolerance of 1e-3 of such a range is up to 25 % of a
// value.
//
// The first half is for tuning; the second half is evaluated once, afterward.
#include <algorithm>
#include <cmath>

#include "identification_set/identification_problems.h"

namespace latsch::identification_set {
namespace {

using std::atan, std::cos, std::exp, std::pow, std::sin, std::sqrt, std::tanh;

Model over_times(const Vector& t, const std::function<double(double, const Vector&)>& y) {
  return [t, y](const Vector& x) {
    Vector values;
    for (const double at : t) values.push_back(y(at, x));
    return values;
  };
}

/// Real and imaginary amplitudes of an oscillator of unit mass.
Vector oscillator(const Vector& x) {
  Vector values;
  for (const double w : grid(0.4, 4, 30)) {
    const double a = x[0] - w * w, b = x[1] * w, square = a * a + b * b;
    values.push_back(x[2] * a / square);
    values.push_back(-x[2] * b / square);
  }
  return values;
}

std::vector<Problem> to_tune_on() {
  std::vector<Problem> all;
  all.push_back(fitted("wide: decay",
                       {{"a", 0, 500, 6, 3.0}, {"k", 0, 100, 2.2, 0.9}, {"c", -100, 100, 0.5, 1.4}},
                       over_times(grid(0, 5, 40), [](double t, const Vector& x) {
                         return x[0] * exp(-x[1] * t) + x[2];
                       })));
  all.push_back(fitted("wide: oscillator",
                       {{"k", 0, 400, 6, 3.2}, {"c", 0, 60, 0.8, 0.3}, {"F", 0, 200, 2.5, 1.1}},
                       oscillator));
  all.push_back(fitted("wide: side force",
                       {{"B", 0, 900, 14, 7.0}, {"C", 0, 60, 1.7, 1.35}, {"D", 0, 300, 2.0, 1.2}},
                       over_times(grid(-0.3, 0.32, 40), [](double s, const Vector& x) {
                         return x[2] * sin(x[1] * atan(x[0] * s));
                       })));
  all.push_back(fitted("wide: hardening spring",
                       {{"k", 0, 3000, 60, 25},
                        {"q", 0, 9000, 200, 70},
                        {"F", -500, 500, 12, 5},
                        {"c", 0, 800, 3, 9}},
                       over_times(grid(0, 1, 41), [](double t, const Vector& x) {
                         const double d = 0.9 * sin(6.0 * t), v = 5.4 * cos(6.0 * t);
                         return x[0] * d + x[1] * d * d * d + x[2] * tanh(v) + x[3] * v;
                       })));
  all.push_back(fitted("wide: saturation",
                       {{"V", 0, 600, 9, 4.0}, {"K", 0, 50, 0.3, 0.8}, {"n", 0, 100, 2.4, 1.6}},
                       over_times(grid(0.1, 4, 30), [](double s, const Vector& x) {
                         const double p = pow(s, x[2]);
                         return x[0] * p / (pow(x[1], x[2]) + p);
                       })));
  return all;
}

std::vector<Problem> to_look_at_once() {
  std::vector<Problem> all;
  all.push_back(
      fitted("wide: two exponentials",
             {{"a", 0, 300, 2, 4}, {"k", 0, 60, 1, 0.5}, {"b", 0, 300, 4, 2}, {"l", 0, 400, 9, 4}},
             over_times(grid(0.05, 4, 40), [](double t, const Vector& x) {
               return x[0] * exp(-x[1] * t) + x[2] * exp(-x[3] * t);
             })));
  all.push_back(fitted("wide: peak",
                       {{"h", 0, 400, 2, 5}, {"p", 0, 900, 5, 6.5}, {"w", 0, 100, 2.5, 1.2}},
                       over_times(grid(0, 12, 45), [](double t, const Vector& x) {
                         const double z = (t - x[1]) / x[2];
                         return x[0] / (1 + z * z);
                       })));
  all.push_back(fitted("wide: friction over speed",
                       {{"F", 0, 200, 1.6, 0.8}, {"v", 0, 30, 0.4, 0.15}, {"c", 0, 50, 0.1, 0.3}},
                       over_times(grid(-2, 2.1, 40), [](double v, const Vector& x) {
                         return x[0] * tanh(v / x[1]) + x[2] * v;
                       })));
  all.push_back(fitted(
      "wide: ring frequencies",
      {{"B", 0, 20, 0.05, 0.12}, {"T", 0, 900, 9, 4}, {"k", 0, 5000, 30, 80}},
      over_times(grid(1, 9, 9), [](double n, const Vector& x) {
        const double s = n * n;
        return sqrt((x[0] * s * (s - 1) * (s - 1) + x[1] * s * (s - 1) + x[2] * s) / (1 + s));
      })));
  all.push_back(fitted("wide: rise with a delay",
                       {{"y", 0, 700, 9, 6}, {"t", 0, 300, 1, 2.5}, {"d", 0, 100, 2, 0.9}},
                       over_times(grid(0, 12, 40), [](double t, const Vector& x) {
                         const double s = t - x[2];
                         return x[0] / (1 + exp(-3 * s)) * (1 - exp(-std::max(0.0, s) / x[1]));
                       })));
  return all;
}

}  // namespace

std::vector<Problem> wide_problems() {
  std::vector<Problem> all = to_tune_on();
  for (Problem& problem : to_look_at_once()) {
    problem.is_held_out = true;
    all.push_back(std::move(problem));
  }
  return all;
}

}  // namespace latsch::identification_set
