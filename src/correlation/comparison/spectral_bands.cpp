// SPDX-License-Identifier: Apache-2.0
#include "correlation/comparison/spectral_bands.h"

#include <algorithm>
#include <cmath>
#include <utility>

#include "measurement/band_level.h"

namespace latsch::correlation {
namespace {

/// Returns z such that a standard normal number lies within ±z with the probability `level`, by
/// bisection.
double normal_bound(double level) {
  double low = 0.0, high = 10.0;
  for (int i = 0; i < 60; ++i) {
    const double z = 0.5 * (low + high);
    (std::erf(z / std::sqrt(2.0)) < level ? low : high) = z;
  }
  return low;
}

double quantile(std::vector<double> values, double p) {
  std::sort(values.begin(), values.end());
  const double at = p * static_cast<double>(values.size() - 1);
  const auto i = std::min(static_cast<std::size_t>(at), values.size() - 2);
  return values[i] + (at - static_cast<double>(i)) * (values[i + 1] - values[i]);
}

/// Half widths of the band around the logarithm of a spectral line, downward and upward.
struct LogReach {
  double down = 0.0, up = 0.0;  // >= 0
};

LogReach reach_of(const ModelComparisonFile& file,
                  const std::vector<MovedDensities>& others,
                  double S,
                  std::size_t channel,
                  std::size_t line,
                  double z) {
  if (file.samples == 0) {
    double sum = 0.0;
    for (const MovedDensities& other : others)
      sum += std::pow(other.count * std::log(other.densities[channel].value[line] / S), 2);
    return {z * std::sqrt(sum), z * std::sqrt(sum)};
  }
  if (others.size() < 2) return {};
  std::vector<double> values;
  for (const MovedDensities& other : others) values.push_back(other.densities[channel].value[line]);
  return {std::max(0.0, std::log(S / quantile(values, 0.5 - 0.5 * file.level))),
          std::max(0.0, std::log(quantile(values, 0.5 + 0.5 * file.level) / S))};
}

/// Returns the variance of the logarithm of the spectrum that the spectra of the fits leave
/// unexplained.
double unexplained(const ComparedModel& model, const std::vector<FitPosterior>& fits, double f) {
  double sum = 0.0;
  for (const std::size_t k : model.fits) sum += std::pow(fits[k].discrepancy.at(f), 2);
  return sum;
}

/// True if a measured line lies in the band widened by noise.
bool holds(
    double measured, double S, double lower, double upper, const LineNoise& noise, double z) {
  // relative change of M over that of S
  const double M = S + noise.density, share = S / M;
  const double off = std::log(measured / M);
  const double down = std::hypot(share * std::log(S / lower), noise.log_quantile(S, -z));
  const double up = std::hypot(share * std::log(upper / S), noise.log_quantile(S, z));
  return off >= -down && off <= up;
}

}  // namespace

void add_bands(const ModelComparisonFile& file,
               const ComparedModel& model,
               const std::vector<FitPosterior>& fits,
               const std::vector<MovedDensities>& others,
               ModelRun& run) {
  if (others.empty()) return;
  const double z = normal_bound(file.level);
  for (std::size_t c = 0; c < run.densities.size(); ++c) {
    const auto& [frequency, S] = run.densities[c];
    std::vector<double> lower(S.size()), upper(S.size());
    for (std::size_t k = 0; k < S.size(); ++k) {
      const LogReach reach = reach_of(file, others, S[k], c, k, z);
      const double missing = z * std::sqrt(unexplained(model, fits, frequency[k]));
      lower[k] = S[k] * std::exp(-std::hypot(reach.down, missing));
      upper[k] = S[k] * std::exp(std::hypot(reach.up, missing));
    }
    run.lower.push_back(std::move(lower));
    run.upper.push_back(std::move(upper));
  }
}

void compare_run(const ModelComparisonFile& file, const CaseComparison& compared, ModelRun& run) {
  const auto& reference = compared.reference;
  const double z = normal_bound(file.level);
  for (const NamedBand& band : file.bands) {
    run.distance.emplace_back();
    run.decibels.emplace_back();
    for (std::size_t c = 0; c < reference.size(); ++c) {
      run.distance.back().push_back(psd_distance(run.densities[c], reference[c], band.band));
      run.decibels.back().push_back(
          log_spectral_distance(run.densities[c], reference[c], band.band));
    }
  }
  for (std::size_t c = 0; c < run.lower.size(); ++c) {
    int lines = 0, inside = 0;
    double reach = 0.0;
    for (std::size_t k = 0; k < reference[c].value.size(); ++k) {
      if (!is_in(reference[c].frequency[k], file.bands[0].band)) continue;
      ++lines;
      reach += 0.5 * std::log(run.upper[c][k] / run.lower[c][k]);
      inside += holds(reference[c].value[k],
                      run.densities[c].value[k],
                      run.lower[c][k],
                      run.upper[c][k],
                      compared.noise[c],
                      z);
    }
    run.coverage.push_back(static_cast<double>(inside) / lines);
    run.reach.push_back(reach / lines);
  }
}

}  // namespace latsch::correlation
