// SPDX-License-Identifier: Apache-2.0
#include "experiment/rigs/car/held_band.h"

#include <algorithm>
#include <cmath>
#include <complex>
#include <vector>

#include "numerics/signals/fft.h"

namespace latsch::experiment {

std::optional<HeldBand> held_band(const FourPostTest& test, PostMode mode, double width) {
  constexpr double kLeast = 1e-4;    // share of the largest power; lines below it contain only
                                     // leakage
  constexpr double kStands = 1e-10;  // m; smaller motions are rounding of a table
  const std::array<double, 4> sign = signs_of(mode);
  const std::size_t count = test.times.size();
  std::vector<double> steps(count, 0.0);
  double way = 0.0;
  for (std::size_t i = 1; i < count; ++i) {
    for (std::size_t post = 0; post < 4; ++post)
      steps[i] += 0.25 * sign[post] * (test.heights[post][i] - test.heights[post][i - 1]);
    way = std::max(way, std::abs(steps[i]));
  }
  if (!(way > kStands)) return std::nullopt;
  const int length = numerics::fast_length(static_cast<int>(count));
  const numerics::Spectrum lines = numerics::real_fft(steps, length);
  std::vector<double> sums(lines.size() + 1, 0.0);
  for (std::size_t k = 0; k < lines.size(); ++k) sums[k + 1] = sums[k] + std::norm(lines[k]);
  const double rate = static_cast<double>(count - 1) / (test.times.back() - test.times.front());
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
