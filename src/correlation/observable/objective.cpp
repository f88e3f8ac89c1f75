// SPDX-License-Identifier: Apache-2.0
#include "correlation/observable/objective.h"

#include <fmt/format.h>

#include <algorithm>
#include <cassert>
#include <cmath>
#include <numeric>

namespace latsch::correlation {
namespace {

/// Sets mean and maximum of the magnitudes of the errors.
void summarize_errors(Comparison& comparison) {
  double sum = 0.0;
  comparison.largest_error = 0.0;
  for (double error : comparison.errors) {
    sum += std::abs(error);
    comparison.largest_error = std::max(comparison.largest_error, std::abs(error));
  }
  comparison.mean_error = sum / static_cast<double>(comparison.errors.size());
}

double mean_power(const std::vector<double>& differences, double k) {
  double sum = 0.0;
  for (double d : differences) sum += std::pow(std::abs(d), k);
  return sum / static_cast<double>(differences.size());
}

double relative(double measured, double simulated) { return (measured - simulated) / measured; }

}  // namespace

void summarize(Comparison& comparison, const ObjectiveSettings& settings) {
  comparison.value = mean_power(comparison.differences, settings.exponent);
  summarize_errors(comparison);
}

Comparison compare_values(const std::vector<double>& measured,
                          const SimulatedValues& simulated,
                          const std::vector<double>& scales,
                          const ObjectiveSettings& settings) {
  assert(measured.size() == simulated.values.size() && measured.size() == scales.size());
  Comparison comparison;
  for (size_t i = 0; i < measured.size(); ++i)
    comparison.errors.push_back((measured[i] - simulated.values[i]) / scales[i]);
  comparison.differences = comparison.errors;
  comparison.pairing.missing = simulated.missing;
  comparison.delay = simulated.delay;
  comparison.compared = simulated.compared;
  for (const int mode : simulated.mixed) comparison.pairing.pairs.push_back({mode, -1, 0.0});
  comparison.value = mean_power(comparison.differences, settings.exponent);
  summarize_errors(comparison);
  const size_t rows = measured.size(), variables = simulated.slopes.size() / rows;
  for (size_t i = 0; i < rows; ++i) {
    for (size_t j = 0; j < variables; ++j)
      comparison.slopes.push_back(-simulated.slopes[j * rows + i] / scales[i]);
  }
  return comparison;
}

Comparison compare_forces(const std::vector<double>& measured,
                          const SimulatedValues& simulated,
                          const ObjectiveSettings& settings) {
  const std::vector<double>& forces = simulated.values;
  assert(!measured.empty() && measured.size() == forces.size());
  const size_t rows = measured.size(), variables = simulated.slopes.size() / rows;
  const bool of_root = settings.compared == Compared::root_force;
  Comparison comparison;
  for (size_t j = 0; j < rows; ++j) {
    assert(measured[j] > 0.0);
    comparison.errors.push_back(relative(measured[j], forces[j]));  // (2)
    const double root = std::sqrt(std::max(0.0, forces[j]));
    comparison.differences.push_back(of_root ? relative(std::sqrt(measured[j]), root)
                                             : comparison.errors.back());
    // At zero force the root of the force has no derivative. It is set to 0, as for a tire without
    // contact.
    const double by_force = !of_root     ? -1.0 / measured[j]
                            : root > 0.0 ? -0.5 / (std::sqrt(measured[j]) * root)
                                         : 0.0;
    for (size_t i = 0; i < variables; ++i)
      comparison.slopes.push_back(by_force * simulated.slopes[i * rows + j]);
  }
  comparison.value = mean_power(comparison.differences, settings.exponent);
  summarize_errors(comparison);
  return comparison;
}

Comparison compare_modes(const std::vector<ModeRecord>& measured,
                         const std::vector<ModeRecord>& simulated,
                         const ObjectiveSettings& settings,
                         const std::vector<double>& slopes) {
  assert(!measured.empty());
  Comparison comparison;
  const size_t modes = simulated.size(), variables = modes == 0 ? 0 : slopes.size() / modes;
  comparison.slopes.assign(measured.size() * variables, 0.0);
  comparison.pairing = pair_modes(measured, simulated, settings.pairing);
  comparison.errors.assign(measured.size(), settings.missing_mode);
  for (const ModePair& pair : comparison.pairing.pairs) {
    ComparedFrequency one{
        pair.measured, simulated[static_cast<size_t>(pair.simulated)].frequency, {}};
    for (size_t i = 0; i < variables; ++i)
      one.slopes.push_back(slopes[i * modes + static_cast<size_t>(pair.simulated)]);
    comparison.compared.push_back(std::move(one));
  }
  order_close(measured,
              comparison.pairing.close,
              /*needs_waves=*/!comparison.pairing.is_by_shape,
              comparison.compared);
  for (const ComparedFrequency& one : comparison.compared) {
    const auto row = static_cast<size_t>(one.measured);
    comparison.errors[row] = relative(measured[row].frequency, one.frequency);  // (1)
    for (size_t i = 0; i < variables; ++i)
      comparison.slopes[row * variables + i] = -one.slopes[i] / measured[row].frequency;
  }
  comparison.differences = comparison.errors;
  comparison.value = mean_power(comparison.differences, settings.exponent);
  summarize_errors(comparison);
  return comparison;
}

void scale_by_noise(Comparison& comparison,
                    const std::vector<double>& sigma,
                    const RobustLoss& loss,
                    double size) {
  const size_t n = comparison.slopes.size() / comparison.differences.size();
  for (size_t k = 0; k < comparison.differences.size(); ++k) {
    const double unit = sigma.empty() ? 1.0 : sigma[k], x = comparison.differences[k] / unit;
    comparison.differences[k] = size * loss(x);
    const double factor = size * loss.slope(x) / unit;
    for (size_t i = 0; i < n; ++i) comparison.slopes[k * n + i] *= factor;
  }
}

double target(const std::vector<Comparison>& comparisons, const std::vector<double>& weights) {
  assert(comparisons.size() == weights.size());
  double sum = 0.0, total = 0.0;
  for (size_t e = 0; e < comparisons.size(); ++e) {
    sum += weights[e] * comparisons[e].value;
    total += weights[e];
  }
  assert(total > 0.0);
  return sum / total;
}

namespace {

std::vector<double> weighted(const std::vector<Comparison>& comparisons,
                             const std::vector<double>& weights,
                             std::vector<double> Comparison::*what) {
  assert(comparisons.size() == weights.size());
  const double total = std::accumulate(weights.begin(), weights.end(), 0.0);
  std::vector<double> all;
  for (size_t e = 0; e < comparisons.size(); ++e) {
    const auto count = static_cast<double>(comparisons[e].differences.size());
    const double factor = std::sqrt(weights[e] / (count * total));
    for (const double one : comparisons[e].*what) all.push_back(factor * one);
  }
  return all;
}

}  // namespace

std::vector<double> weighted_residuals(const std::vector<Comparison>& comparisons,
                                       const std::vector<double>& weights) {
  return weighted(comparisons, weights, &Comparison::differences);
}

std::vector<double> weighted_slopes(const std::vector<Comparison>& comparisons,
                                    const std::vector<double>& weights) {
  for (const Comparison& comparison : comparisons)
    if (comparison.slopes.empty()) return {};
  return weighted(comparisons, weights, &Comparison::slopes);
}

std::string target_in_words(const std::vector<double>& exponents, double target) {
  const bool alike =
      std::adjacent_find(exponents.begin(), exponents.end(), std::not_equal_to<>()) ==
      exponents.end();
  if (exponents.empty()) return "";
  const double k = exponents.front();
  if (alike && k == 1.0) return "mean of the errors";
  if (!alike) return "mean of the errors, each to the exponent of its experiment";
  const double root = 100.0 * std::pow(target, 1.0 / k);
  if (k == 2.0) return fmt::format("mean square of the errors, its root {:.3g} %", root);
  return fmt::format("mean of the errors to the power {:g}, its root {:.3g} %", k, root);
}

}  // namespace latsch::correlation
