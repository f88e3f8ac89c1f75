// SPDX-License-Identifier: Apache-2.0
#include "measurement/band_level.h"

#include <algorithm>
#include <cassert>
#include <cmath>

namespace latsch {

std::vector<FrequencyBand> third_octave_bands(FrequencyBand range) {
  std::vector<FrequencyBand> bands;
  const int first = static_cast<int>(std::ceil(10.0 * std::log10(range.lower) - 1e-9));
  for (int n = first; std::pow(10.0, n / 10.0) <= range.upper * (1.0 + 1e-9); ++n) {
    bands.push_back({std::pow(10.0, (n - 0.5) / 10.0), std::pow(10.0, (n + 0.5) / 10.0)});
  }
  return bands;
}

double band_power(const numerics::Density& density, FrequencyBand band) {
  assert(density.frequency.size() >= 2);
  const double width = density.frequency[1] - density.frequency[0];
  double sum = 0.0;
  for (std::size_t k = 0; k < density.value.size(); ++k) {
    const double lower = std::max(band.lower, density.frequency[k] - width / 2.0);
    const double upper = std::min(band.upper, density.frequency[k] + width / 2.0);
    if (upper > lower) sum += density.value[k] * (upper - lower);
  }
  return sum;
}

double band_level(const numerics::Density& density, FrequencyBand band, double reference) {
  return 10.0 * std::log10(band_power(density, band) / (reference * reference));
}

double log_spectral_distance(const numerics::Density& a,
                             const numerics::Density& b,
                             FrequencyBand band) {
  assert(a.value.size() == b.value.size());
  double sum = 0.0;
  int count = 0;
  for (std::size_t k = 0; k < a.value.size(); ++k) {
    const bool inside = a.frequency[k] >= band.lower && a.frequency[k] <= band.upper;
    if (!inside || a.value[k] <= 0.0 || b.value[k] <= 0.0) continue;
    sum += std::pow(10.0 * std::log10(a.value[k] / b.value[k]), 2);
    ++count;
  }
  return count > 0 ? std::sqrt(sum / count) : 0.0;
}

}  // namespace latsch
