// SPDX-License-Identifier: Apache-2.0
// Weights of the fitted experiments of a study relative to each other. They depend on the stated
// noise, and a robust loss reduces the weight of a value that is far off.
#pragma once

#include <optional>
#include <vector>

#include "correlation/study/study.h"

namespace latsch::correlation {

std::vector<StudyExperiment> fitted_experiments(const Study& study);

/// Returns the common standard deviation of all values, the mean with weights 1 / sigma^2; nullopt
/// if an experiment with positive weight states no noise.
std::optional<double> common_deviation(const std::vector<StudyExperiment>& fitted);

/// Weights the differences as the fit does: by their noise, so that a difference with the common
/// standard deviation keeps its size, and by the robust loss, which reduces values that are far
/// off. The result is proportional to `common`.
void weigh(const StudyExperiment& experiment,
           const std::optional<double>& common,
           Comparison& comparison);

}  // namespace latsch::correlation
