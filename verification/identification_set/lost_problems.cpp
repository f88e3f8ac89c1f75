// SPDX-License-Identifier: Apache-2.0
// Problems in which a variable has no effect at the start: a peak outside of the data, a stop that
// is never touched, or a decay that is over before the first sample. Starts are off by factors of
// two to a hundred, and the bounds are centered at neither the start nor the true values.
//
// The treatment of such variables was designed with the first half of the problems; the second half
// was evaluated once, afterward.
#include <algorithm>
#include <cmath>
#include <complex>

#include "identification_set/identification_problems.h"

namespace latsch::identification_set {
namespace {

using std::abs, std::atan, std::exp, std::max, std::sin, std::tanh;

Model curve(const Vector& t, const std::function<double(double, const Vector&)>& y) {
  return [t, y](const Vector& x) {
    Vector values;
    for (const double at : t) values.push_back(y(at, x));
    return values;
  };
}

Vector response(double k, double c, double m, double first, double last) {
  Vector values;
  for (const double w : grid(first, last, 30)) {
    const auto H = 1.0 / std::complex<double>(k - m * w * w, c * w);
    values.push_back(H.real());
    values.push_back(H.imag());
  }
  return values;
}

std::vector<Problem> decided_by() {
  std::vector<Problem> all;
  all.push_back(fitted("a peak beyond the data",
                       {{"c", -1, 3, 0.5, 1.0},
                        {"s", -1, 1, 0.2, 0.1},
                        {"h", 0.1, 20, 5.0, 1.5},
                        {"p", 0, 40, 28.0, 6.0},
                        {"w", 0.3, 5, 0.8, 1.1}},
                       curve(grid(0, 10, 41), [](double t, const Vector& x) {
                         const double z = (t - x[3]) / x[4];
                         return x[0] + x[1] * t + x[2] * exp(-z * z);
                       })));
  all.push_back(fitted("a decay over before the first sample",
                       {{"a", 0, 4, 1, 1.5}, {"b", 0, 9, 2, 2.5}, {"k", 0.2, 500, 300, 4.0}},
                       curve(grid(0.1, 2, 30), [](double t, const Vector& x) {
                         return x[0] + x[1] * exp(-x[2] * t);
                       })));
  all.push_back(fitted(
      "a stop never touched",
      {{"k", 50, 500, 100, 180}, {"gap", 0, 0.2, 0.12, 0.03}, {"ks", 10, 5000, 3000, 600}},
      curve(grid(0, 0.06, 25),
            [](double d, const Vector& x) { return x[0] * d + x[2] * max(0.0, d - x[1]); })));
  all.push_back(fitted("friction saturated at every speed",
                       {{"F", 0.1, 5, 0.7, 1.2}, {"vr", 1e-4, 10, 5e-4, 0.2}, {"c", 0, 2, 1, 0.15}},
                       curve(grid(-2, 2, 40), [](double v, const Vector& x) {
                         return x[0] * tanh(v / x[1]) + x[2] * v;
                       })));
  all.push_back(
      fitted("relaxation slower than the test",
             {{"E0", 0.1, 10, 3, 1.0}, {"E1", 0.05, 20, 0.2, 1.6}, {"tau", 0.01, 1e6, 2e5, 3.0}},
             curve(grid(0.1, 12, 30),
                   [](double t, const Vector& x) { return x[0] + x[1] * exp(-t / x[2]); })));
  all.push_back(fitted("a step after the end",
                       {{"L", 0.2, 9, 2, 3.0},
                        {"k", 0.5, 30, 20, 2.0},
                        {"t0", 0, 60, 40, 7.0},
                        {"c", -1, 2, 1, 0.4}},
                       curve(grid(0, 15, 40), [](double t, const Vector& x) {
                         return x[3] + x[0] / (1 + exp(-x[1] * (t - x[2])));
                       })));
  all.push_back(fitted("two peaks, one of them outside",
                       {{"h1", 0.1, 5, 1, 2.0},
                        {"p1", 0, 10, 4, 3.0},
                        {"w1", 0.2, 3, 1, 0.9},
                        {"h2", 0.1, 5, 4, 1.0},
                        {"p2", 5, 90, 55, 7.5},
                        {"w2", 0.2, 9, 3, 1.2}},
                       curve(grid(0, 10, 51), [](double t, const Vector& x) {
                         const double a = (t - x[1]) / x[2], b = (t - x[4]) / x[5];
                         return x[0] * exp(-a * a) + x[3] * exp(-b * b);
                       })));
  all.push_back(
      fitted("a resonance above the band",
             {{"k", 0.5, 200, 4, 9.0}, {"c", 0.02, 5, 1, 0.3}, {"m", 1e-4, 10, 5e-4, 1.0}},
             [](const Vector& x) { return response(x[0], x[1], x[2], 0.5, 5.0); }));
  return all;
}

std::vector<Problem> looked_at_once() {
  std::vector<Problem> all;
  all.push_back(fitted("a dip far behind the sweep",
                       {{"a", 0, 6, 4, 2.2},
                        {"d", 0.05, 9, 0.4, 1.4},
                        {"p", -5, 70, 50, 12.0},
                        {"w", 0.5, 8, 1.5, 2.0}},
                       curve(grid(0, 20, 45), [](double t, const Vector& x) {
                         const double z = (t - x[2]) / x[3];
                         return x[0] - x[1] / (1 + z * z * z * z);
                       })));
  all.push_back(fitted("two decays, one at once over",
                       {{"a", 0, 7, 3, 1.0},
                        {"k", 0.02, 9, 0.9, 0.4},
                        {"b", 0, 3, 0.6, 2.0},
                        {"l", 0.5, 900, 400, 6.0}},
                       curve(grid(0.05, 5, 40), [](double t, const Vector& x) {
                         return x[0] * exp(-x[1] * t) + x[2] * exp(-x[3] * t);
                       })));
  all.push_back(fitted("bump stops on both sides, none reached",
                       {{"k", 5, 90, 60, 22},
                        {"g", 0, 0.5, 0.4, 0.06},
                        {"h", 0, 0.5, 0.33, 0.09},
                        {"s", 5, 900, 40, 250}},
                       curve(grid(-0.15, 0.15, 31), [](double d, const Vector& x) {
                         return x[0] * d + x[3] * (max(0.0, d - x[1]) - max(0.0, -d - x[2]));
                       })));
  all.push_back(fitted(
      "slip stiffness beyond the sweep",
      {{"B", 0.5, 5000, 2500, 12}, {"D", 0.2, 4, 1.7, 1.1}, {"H", -0.05, 0.02, 0, 0.004}},
      curve(grid(-0.2, 0.21, 35),
            [](double s, const Vector& x) { return x[1] * sin(1.4 * atan(x[0] * (s + x[2]))); })));
  all.push_back(
      fitted("a plateau of viscosity never seen",
             {{"n0", 0.2, 40, 3, 9.0}, {"n1", 0.01, 3, 1, 0.1}, {"l", 1e-6, 50, 5e-6, 0.6}},
             curve(grid(-2, 2, 25), [](double d, const Vector& x) {
               const double rate = std::pow(10.0, d);
               return x[1] + (x[0] - x[1]) / (1 + x[2] * rate);
             })));
  all.push_back(fitted("a switch long before the start",
                       {{"u", -4, 9, 1, 0.5},
                        {"v", -4, 9, 2, 3.0},
                        {"t", -90, 12, -60, 5.0},
                        {"r", 0.1, 7, 0.4, 0.8}},
                       curve(grid(0, 10, 36), [](double t, const Vector& x) {
                         return x[0] + (x[1] - x[0]) * 0.5 * (1 + tanh((t - x[2]) / x[3]));
                       })));
  all.push_back(fitted("three lines of a spectrum, two not in it",
                       {{"a1", 0.1, 5, 1, 1.5},
                        {"f1", 1, 9, 3, 2.5},
                        {"a2", 0.1, 9, 2, 1.0},
                        {"f2", 3, 80, 30, 5.0},
                        {"a3", 0.1, 3, 2, 0.7},
                        {"f3", 5, 80, 66, 8.0}},
                       curve(grid(0, 10, 61), [](double t, const Vector& x) {
                         double sum = 0.0;
                         for (int k = 0; k < 3; ++k) {
                           const double z = t - x[2 * k + 1];
                           sum += x[2 * k] / (1 + 2 * z * z);
                         }
                         return sum;
                       })));
  all.push_back(
      fitted("a resonance below the band",
             {{"k", 1e-3, 60, 2e-3, 6.0}, {"c", 0.02, 8, 0.1, 0.5}, {"m", 0.2, 5, 3, 1.0}},
             [](const Vector& x) { return response(x[0], x[1], x[2], 1.0, 9.0); }));
  for (Problem& problem : all) problem.is_held_out = true;
  return all;
}

}  // namespace

std::vector<Problem> lost_problems() {
  std::vector<Problem> all = decided_by();
  for (Problem& problem : looked_at_once()) all.push_back(std::move(problem));
  return all;
}

}  // namespace latsch::identification_set
