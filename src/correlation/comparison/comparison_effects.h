// SPDX-License-Identifier: Apache-2.0
// What distances of models to a reference depend on.
//
// Two factors of two levels each, d_ij the distance at level i of the first and j of the second
// [Box, Hunter & Hunter, Statistics for Experimenters, ch. 5: the 2² factorial design]:
//   first       ((d_10 + d_11) - (d_00 + d_01))/2
//   second      ((d_01 + d_11) - (d_00 + d_10))/2
//   interaction ((d_11 - d_10) - (d_01 - d_00))/2
// A negative effect brings the model nearer. Over several cases they are means, and the share of
// cases in which the first is the larger one tells whether that is a rule.
//
// Over the grid of a test: the mean distance at each level of a varied number, over the levels of
// the others; its range is the sensitivity.
#pragma once

#include <array>
#include <string>
#include <vector>

#include "correlation/comparison/model_comparison.h"

namespace latsch::correlation {

struct FactorialEffects {
  std::array<std::array<double, 2>, 2> distance{};  // d_ij
  double first = 0.0, second = 0.0, interaction = 0.0;
  double first_is_larger = 0.0;  // share of the cases
};

FactorialEffects effects_of(const std::array<std::array<double, 2>, 2>& distance);
/// Means over the cases, in the band, by distance or decibels.
FactorialEffects mean_effects(const ModelComparisonFile& file,
                              const ModelComparison& comparison,
                              const std::vector<std::size_t>& cases,
                              std::size_t band,
                              bool in_decibels);

struct GridSensitivity {
  std::size_t test = 0, varied = 0;
  std::vector<std::vector<double>> mean;  // by model and level, of the distance in the first band
  double range(std::size_t model) const;  // largest less smallest
};

std::vector<GridSensitivity> sensitivities(const ModelComparisonFile& file,
                                           const ModelComparison& comparison);

/// The cases of a test, or all.
std::vector<std::size_t> cases_of(const ModelComparisonFile& file, std::size_t test);
std::vector<std::size_t> all_cases(const ModelComparisonFile& file);

/// Mean distance of a model over cases in a band.
double mean_distance(const ModelComparison& comparison,
                     const std::vector<std::size_t>& cases,
                     std::size_t model,
                     std::size_t band,
                     bool in_decibels = false);

}  // namespace latsch::correlation
