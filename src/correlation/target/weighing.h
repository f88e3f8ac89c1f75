// SPDX-License-Identifier: Apache-2.0
// Weights of the fitted experiments of a study relative to each other: by the noise they state, and
// lower if a robust loss finds a value far off.
#pragma once

#include <optional>
#include <vector>

#include "correlation/study/study.h"

namespace latsch::correlation {

std::vector<StudyExperiment> fitted_experiments(const Study& study);

/// Returns the common deviation of all values, the mean with weights 1 / sigma^2; nullopt if an
/// experiment that counts states no noise.
std::optional<double> common_deviation(const std::vector<StudyExperiment>& fitted);

/// Weights the differences as the fit does: by their noise, such that a difference with the common
/// deviation keeps its size, and by the robust loss, which reduces far-off values. The result is
/// linear in `common`.
void weigh(const StudyExperiment& experiment,
           const std::optional<double>& common,
           Comparison& comparison);

}  // namespace latsch::correlation
