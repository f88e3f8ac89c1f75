// SPDX-License-Identifier: Apache-2.0
// Problems whose residuals leap: labels of modes swap, a preload opens, an amplitude falls from one
// branch to another in a sweep of frequencies. Every problem has eight starts.
//
// The first half is for tuning; the second half is evaluated once, afterward.
#include <algorithm>
#include <cmath>

#include "base/random.h"
#include "identification_set/identification_problems.h"

namespace latsch::identification_set {
namespace {

using std::abs, std::exp, std::max, std::sqrt;

constexpr int kStarts = 8;

/// Force of a spring with preload over the travel: soft until the preload opens, then with a leap.
Vector opening_preload(const Vector& x) {
  Vector values;
  for (const double d : grid(0, 20, 25)) {
    const bool is_open = d > x[2];
    values.push_back(is_open ? x[1] + x[3] * (d - x[2]) : x[0] * d);
  }
  return values;
}

/// Two frequencies, in the order of their participation, and three loads.
Vector swapped_labels(const Vector& x) {
  const double mean = 0.5 * (x[0] + x[1]), half = 0.5 * (x[0] - x[1]);
  const double split = sqrt(half * half + x[2] * x[2]);
  const double low = sqrt(mean - split), high = sqrt(mean + split);
  const bool is_swapped = x[0] + 0.3 * x[2] > x[1];
  Vector values{is_swapped ? high : low, is_swapped ? low : high};
  for (const double d : {0.5, 1.0, 1.5}) values.push_back(0.3 * x[0] * d + 0.1 * x[1] * d * d);
  values.push_back(0.2 * (x[1] - 0.4 * x[2]));
  return values;
}

/// Amplitudes of a hardening oscillator in an upward sweep: the upper branch up to the leap.
Vector upward_sweep(const Vector& x) {
  const double k = x[0], c = x[1], q = x[2], F = 1.0;
  Vector values;
  double amplitude = 0.0;
  for (const double w : grid(0.5, 2.6, 43)) {
    // The largest root a of ((k + 3/4 q a^2 - w^2) a)^2 + (c w a)^2 = F^2 below that of before
    // the leap, found by a scan downward from above.
    const auto excess = [&](double a) {
      const double stiff = (k + 0.75 * q * a * a - w * w) * a, lossy = c * w * a;
      return stiff * stiff + lossy * lossy - F * F;
    };
    const double most = F / (c * w);
    double above = most;
    for (int i = 1; i <= 400; ++i) {
      const double below = most * (1.0 - i / 400.0);
      if (excess(below) < 0.0) {
        double low = below, high = above;
        for (int j = 0; j < 50; ++j) {
          const double middle = 0.5 * (low + high);
          (excess(middle) < 0.0 ? low : high) = middle;
        }
        amplitude = 0.5 * (low + high);
        break;
      }
      above = below;
    }
    values.push_back(amplitude);
  }
  return values;
}

/// Loads of a beam that touches stops one after the other, each with the leap of its preload.
Vector stops_with_preload(const Vector& x) {
  Vector values;
  for (const double d : grid(0, 10, 31)) {
    double force = x[0] * d;
    if (d > x[1]) force += x[2];
    if (d > x[3]) force += 0.5 * x[2] + x[4] * (d - x[3]);
    values.push_back(force);
  }
  return values;
}

/// Three frequencies that are distinguished by which of two masses moves more.
Vector three_labels(const Vector& x) {
  const double a = x[0] + x[2], b = x[1] + x[2], coupling = x[2];
  const double mean = 0.5 * (a + b), half = 0.5 * (a - b);
  const double split = sqrt(half * half + coupling * coupling);
  const bool first_is_low = a < b;
  const double low = sqrt(mean - split), high = sqrt(mean + split);
  Vector values{first_is_low ? low : high, first_is_low ? high : low, sqrt(mean + x[3])};
  for (const double d : {0.4, 0.8, 1.2}) values.push_back(d * (0.2 * x[0] + 0.1 * x[3] * d));
  values.push_back(0.3 * x[1]);
  return values;
}

/// Slip and stick: the force holds until a limit and falls at once to that of sliding.
Vector breakaway(const Vector& x) {
  Vector values;
  for (const double d : grid(0, 3, 31)) {
    const double held = x[0] * d;
    values.push_back(held < x[1] ? held : x[2] + (x[1] - x[2]) * exp(-x[3] * d) * 0.2);
  }
  return values;
}

std::vector<Problem> with_starts(const std::string& name,
                                 const std::vector<Number>& numbers,
                                 const Model& model,
                                 double spread) {
  std::vector<Problem> all;
  for (int k = 0; k < kStarts; ++k) {
    RandomStream random(53, k);
    std::vector<Number> moved = numbers;
    for (Number& number : moved) {
      const double factor = exp(spread * (2.0 * random.uniform() - 1.0));
      number.start = std::clamp(number.truth * factor, number.lower, number.upper);
    }
    Problem problem = fitted(name, moved, model);
    problem.name += ", start " + std::to_string(k + 1);
    all.push_back(std::move(problem));
  }
  return all;
}

void add(std::vector<Problem>& all, std::vector<Problem> more, bool is_held_out) {
  for (Problem& problem : more) {
    problem.is_held_out = is_held_out;
    all.push_back(std::move(problem));
  }
}

}  // namespace

std::vector<Problem> leaping_problems() {
  std::vector<Problem> all;
  const auto tune = [&](std::vector<Problem> more) { add(all, std::move(more), false); };
  const auto look_once = [&](std::vector<Problem> more) { add(all, std::move(more), true); };
  tune(with_starts(
      "preload that opens",
      {{"s", 0.5, 20, 0, 4}, {"P", 10, 300, 0, 70}, {"g", 2, 19, 0, 9}, {"k", 0.5, 30, 0, 6}},
      opening_preload,
      0.7));
  tune(with_starts("labels that swap",
                   {{"a", 0.5, 20, 0, 4}, {"b", 0.5, 20, 0, 5}, {"c", 0.05, 2, 0, 0.5}},
                   swapped_labels,
                   0.6));
  tune(with_starts("upward sweep",
                   {{"k", 0.3, 3, 0, 1}, {"c", 0.02, 1, 0, 0.15}, {"q", 0.005, 1, 0, 0.06}},
                   upward_sweep,
                   0.6));
  look_once(with_starts("stops with preload",
                        {{"k", 0.5, 30, 0, 5},
                         {"g", 0.5, 6, 0, 3},
                         {"P", 2, 90, 0, 15},
                         {"h", 3, 9.5, 0, 6.2},
                         {"s", 0.5, 60, 0, 9}},
                        stops_with_preload,
                        0.5));
  look_once(with_starts(
      "three labels",
      {{"a", 0.5, 30, 0, 6}, {"b", 0.5, 30, 0, 7}, {"c", 0.1, 9, 0, 1}, {"d", 0.1, 40, 0, 5}},
      three_labels,
      0.6));
  look_once(with_starts(
      "breakaway",
      {{"k", 0.2, 20, 0, 2}, {"H", 0.5, 9, 0, 3}, {"S", 0.2, 6, 0, 1.8}, {"l", 0.05, 9, 0, 0.8}},
      breakaway,
      0.5));
  return all;
}

}  // namespace latsch::identification_set
