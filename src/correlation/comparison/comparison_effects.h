// SPDX-License-Identifier: Apache-2.0
// Effects of design factors on the distance of models to a reference.
//
// A factorial design has two factors of two levels each; d_ij is the distance at level i of the
// first and j of the second [Box, Hunter & Hunter, Statistics for Experimenters, ch. 5: the 2²
// factorial design]:
//   first       ((d_10 + d_11) - (d_00 + d_01))/2
//   second      ((d_01 + d_11) - (d_00 + d_10))/2
//   interaction ((d_11 - d_10) - (d_01 - d_00))/2
// A negative effect brings the model nearer. Over several cases the effects are means, and the
// share of cases in which the first effect is the larger one shows whether that is a rule.
//
// Over the grid of a test, the mean distance at each level of a varied number is taken over the
// levels of the others; the range of these means is the sensitivity.
#pragma once

#include <array>
#include <string>
#include <vector>

#include "correlation/comparison/model_comparison.h"

namespace latsch::correlation {

struct FactorialEffects {
  std::array<std::array<double, 2>, 2> distance{};  // d_ij
  double first = 0.0, second = 0.0, interaction = 0.0;
  double first_is_larger = 0.0;  // share of the cases, 0 to 1
};

FactorialEffects effects_of(const std::array<std::array<double, 2>, 2>& distance);
/// Returns the means over the cases in the band, of the distance or of the decibels.
FactorialEffects mean_effects(const ModelComparisonFile& file,
                              const ModelComparison& comparison,
                              const std::vector<std::size_t>& cases,
                              std::size_t band,
                              bool in_decibels);

struct GridSensitivity {
  std::size_t test = 0, varied = 0;
  std::vector<std::vector<double>> mean;  // mean distance in the first band, [model][level]
  double range(std::size_t model) const;  // Returns the largest minus the smallest mean.
};

std::vector<GridSensitivity> sensitivities(const ModelComparisonFile& file,
                                           const ModelComparison& comparison);

/// Returns the cases of one test; all_cases() returns those of all tests.
std::vector<std::size_t> cases_of(const ModelComparisonFile& file, std::size_t test);
std::vector<std::size_t> all_cases(const ModelComparisonFile& file);

/// Returns the mean distance of a model over the cases in a band.
double mean_distance(const ModelComparison& comparison,
                     const std::vector<std::size_t>& cases,
                     std::size_t model,
                     std::size_t band,
                     bool in_decibels = false);

}  // namespace latsch::correlation
