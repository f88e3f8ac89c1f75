// SPDX-License-Identifier: Apache-2.0
#include "correlation/observable/curve_delay.h"

#include <algorithm>
#include <cmath>
#include <numeric>

namespace latsch::correlation {
namespace {

constexpr double kWidest = 0.1;  // share of the record, in either direction
constexpr int kCoarsest = 20;    // steps of the grid at least
// largest number of grid steps; a finer grid takes longer and finds no better delay
constexpr int kFinest = 2000;
constexpr int kMostDelaySteps = 30;  // Gauss-Newton steps; two or three are usual
// share of a simulated time step; a smaller range is only rounding of the times
constexpr double kRoom = 1e-3;
constexpr double kSettled = 1e-12;  // share of the range; a smaller step ends the search

double dot(const std::vector<double>& a, const std::vector<double>& b) {
  return std::inner_product(a.begin(), a.end(), b.begin(), 0.0);
}

/// Returns the delay with the least sum of squares on the grid.
double best_of_grid(const DelayRange& range,
                    int steps,
                    const std::function<DelayedDifferences(double)>& differences) {
  double best = range.lower, least = 0.0;
  for (int k = 0; k <= steps; ++k) {
    const double at = range.lower + (range.upper - range.lower) * k / steps;
    const auto d = differences(at).d;
    const double sum = dot(d, d);
    if (k == 0 || sum < least) {
      best = at;
      least = sum;
    }
  }
  return best;
}

}  // namespace

std::optional<DelayRange> delay_range(const std::vector<double>& measured,
                                      const std::vector<double>& simulated) {
  const double widest = kWidest * (measured.back() - measured.front());
  DelayRange range{std::max(-widest, measured.back() - simulated.back()),
                   std::min(widest, measured.front() - simulated.front()),
                   (simulated.back() - simulated.front()) /
                       static_cast<double>(std::max<std::size_t>(simulated.size() - 1, 1))};
  if (range.upper - range.lower <= kRoom * range.step) return std::nullopt;
  return range;
}

FittedDelay fit_delay(const DelayRange& range,
                      const std::function<DelayedDifferences(double)>& differences) {
  const double width = range.upper - range.lower;
  const int steps =
      range.step > 0.0
          ? std::clamp(static_cast<int>(std::min(width / range.step, 1e6)) + 1, kCoarsest, kFinest)
          : kCoarsest;
  FittedDelay delay{best_of_grid(range, steps, differences)};
  const double lower = std::max(range.lower, delay.value - width / steps);
  const double upper = std::min(range.upper, delay.value + width / steps);
  DelayedDifferences at = differences(delay.value);
  double sum = dot(at.d, at.d);
  for (int k = 0; k < kMostDelaySteps; ++k) {
    delay.stiffness = dot(at.by_delay, at.by_delay);
    if (!(delay.stiffness > 0.0)) break;
    double step = -dot(at.by_delay, at.d) / delay.stiffness;
    // If there is a kink between two samples, a whole step may be too long, so steps are halved.
    bool is_better = false;
    for (int halving = 0; halving < 8 && !is_better; ++halving, step *= 0.5) {
      const double next = std::clamp(delay.value + step, lower, upper);
      if (std::abs(next - delay.value) <= kSettled * width) break;
      DelayedDifferences there = differences(next);
      const double new_sum = dot(there.d, there.d);
      if (new_sum >= sum) continue;
      is_better = true;
      delay.value = next;
      sum = new_sum;
      at = std::move(there);
    }
    if (!is_better) break;
  }
  delay.at_end = width > 0.0 && (delay.value <= range.lower + kSettled * width ||
                                 delay.value >= range.upper - kSettled * width);
  return delay;
}

void project_out(const std::vector<double>& by_delay,
                 std::vector<double>& slopes,
                 FittedDelay& delay) {
  const std::size_t rows = by_delay.size();
  const double stiffness = dot(by_delay, by_delay);
  if (delay.at_end || !(stiffness > 0.0)) {
    delay.slopes.assign(slopes.size() / rows, 0.0);
    return;
  }
  for (std::size_t column = 0; column < slopes.size(); column += rows) {
    const auto begin = slopes.begin() + static_cast<std::ptrdiff_t>(column);
    const double along =
        std::inner_product(by_delay.begin(), by_delay.end(), begin, 0.0) / stiffness;
    for (std::size_t i = 0; i < rows; ++i) slopes[column + i] -= along * by_delay[i];
    delay.slopes.push_back(-along);
  }
}

}  // namespace latsch::correlation
