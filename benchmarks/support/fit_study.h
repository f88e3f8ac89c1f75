// SPDX-License-Identifier: Apache-2.0
// Fits a study of studies/ from the beginning, in worker processes of the program, with a separate
// journal.
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
  double cpu_time = 0.0;   // s, for all trials
};

/// Returns studies/NAME/study.toml.
correlation::Study study_of_folder(const std::string& name);

/// Returns the study in a temporary folder, its tires on a coarse mesh if one is given, with
/// measurements computed from the present model. On a coarse mesh modes are measured with their
/// shapes and paired by these: there a label, which names the larger of two parts of a shape, may
/// change near the truth, and the mode with that label would have an error of 100 %.
correlation::Study fresh_twin(const std::string& name,
                              const std::optional<CoarseMesh>& mesh = std::nullopt);

/// Returns the values of the variables in the model's own file, which a twin has to find.
DesignPoint true_point(const correlation::Study& study);

/// Fits the study. The program `latsch` has to be beside the benchmark.
Fit fit(const correlation::Study& study, int workers);

/// Returns the path of bin/latsch.
std::filesystem::path program();

}  // namespace latsch::benchmarks
