// SPDX-License-Identifier: Apache-2.0
// How the fitted experiments of a study count against each other: by the noise they state, and less
// where a robust loss finds a value far off.
#pragma once

#include <optional>
#include <vector>

#include "correlation/study/study.h"

namespace latsch::correlation {

std::vector<StudyExperiment> fitted_experiments(const Study& study);

/// The deviation that all values together have in the mean of their weights 1 / sigma^2; nullopt
/// where an experiment that counts states no noise.
std::optional<double> common_deviation(const std::vector<StudyExperiment>& fitted);

/// Differences as the fit counts them: by their noise, so that one of common deviation keeps its
/// size, and less where a robust loss finds them far off. Linear in `common`.
void weigh(const StudyExperiment& experiment,
           const std::optional<double>& common,
           Comparison& comparison);

}  // namespace latsch::correlation
