// SPDX-License-Identifier: Apache-2.0
// Fits a study of the folder studies/ from the beginning, in worker processes of the program, with
// a separate journal.
#pragma once

#include <filesystem>
#include <optional>
#include <string>

#include "coarse_mesh.h"
#include "correlation/study/study.h"
#include "evaluation/schedule/scheduler.h"

namespace latsch::benchmarks {

struct Fit {
  Run run;
  long trials = 0;
  double wall_time = 0.0;  // s
  double cpu_time = 0.0;   // s, sum over all trials
};

/// Returns studies/NAME/study.toml.
correlation::Study study_of_folder(const std::string& name);

/// Returns the study, copied to a temporary folder, with measurements computed by the present
/// model. If `mesh` is given, its tires have this coarse mesh. On a coarse mesh modes are measured
/// with their shapes and paired by shape, not by label: a label names the larger of two parts of a
/// shape, so it may change near the true values, and the mode with that label would then have an
/// error of 100 %.
correlation::Study fresh_twin(const std::string& name,
                              const std::optional<CoarseMesh>& mesh = std::nullopt);

/// Returns the values of the variables in the model's file. They are the true values of the fit.
DesignPoint true_point(const correlation::Study& study);

/// Fits the study. The program `latsch` has to be beside the benchmark.
Fit fit(const correlation::Study& study, int workers);

/// Returns the path of the program, bin/latsch.
std::filesystem::path program();

}  // namespace latsch::benchmarks
