// SPDX-License-Identifier: Apache-2.0
#include "experiment/rigs/car/held_band.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <complex>
#include <vector>

#include "numerics/signals/fft.h"

namespace latsch::experiment {

namespace {

/// Returns the motion of the mode from sample to sample, m; 0 for the first.
std::vector<double> steps_of(const FourPostTest& test, PostMode mode) {
  const std::array<double, 4> sign = signs_of(mode);
  std::vector<double> steps(test.times.size(), 0.0);
  for (std::size_t i = 1; i < steps.size(); ++i)
    for (std::size_t post = 0; post < 4; ++post)
      steps[i] += 0.25 * sign[post] * (test.heights[post][i] - test.heights[post][i - 1]);
  return steps;
}

double rate_of(const FourPostTest& test) {
  return static_cast<double>(test.times.size() - 1) / (test.times.back() - test.times.front());
}

}  // namespace

double share_above(const FourPostTest& test, PostMode mode, double frequency) {
  const std::vector<double> steps = steps_of(test, mode);
  const int length = numerics::fast_length(static_cast<int>(steps.size()));
  const numerics::Spectrum lines = numerics::real_fft(steps, length);
  const double spacing = rate_of(test) / length;
  double all = 0.0, above = 0.0;
  for (std::size_t k = 1; k < lines.size(); ++k) {
    const double power = std::norm(lines[k]);
    all += power;
    if (static_cast<double>(k) * spacing > frequency) above += power;
  }
  return all > 0.0 ? above / all : 0.0;
}

std::optional<HeldBand> held_band(const FourPostTest& test, PostMode mode, double width) {
  // share of the largest power; lines with less power contain only leakage
  constexpr double kLeast = 1e-4;
  constexpr double kStands = 1e-10;  // m; smaller motions are rounding of a table
  const std::vector<double> steps = steps_of(test, mode);
  const std::size_t count = steps.size();
  double way = 0.0;
  for (const double step : steps) way = std::max(way, std::abs(step));
  if (!(way > kStands)) return std::nullopt;
  const int length = numerics::fast_length(static_cast<int>(count));
  const numerics::Spectrum lines = numerics::real_fft(steps, length);
  std::vector<double> sums(lines.size() + 1, 0.0);
  for (std::size_t k = 0; k < lines.size(); ++k) sums[k + 1] = sums[k] + std::norm(lines[k]);
  const double rate = rate_of(test);
  const double spacing = rate / length;
  const long beside = std::max(1L, std::lround(width / spacing)), last = std::ssize(lines) - 1;
  const auto power = [&](long k) {
    const long low = std::max(1L, k - beside), high = std::min(last, k + beside);
    return (sums[static_cast<std::size_t>(high + 1)] - sums[static_cast<std::size_t>(low)]) /
           static_cast<double>(high - low + 1);
  };
  double most = 0.0;
  for (long k = 1; k <= last; ++k) most = std::max(most, power(k));
  HeldBand band{rate, 0.0};
  for (long k = 1; k <= last; ++k) {
    if (power(k) < kLeast * most) continue;
    band.from = std::min(band.from, static_cast<double>(k) * spacing);
    band.to = static_cast<double>(k) * spacing;
  }
  return band;
}

}  // namespace latsch::experiment
