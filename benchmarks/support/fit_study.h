// SPDX-License-Identifier: Apache-2.0
// Fits a study of studies/ from the beginning, in worker processes of the program, with a journal
// of its own.
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
  double cpu_time = 0.0;   // s, of all trials
};

/// studies/NAME/study.toml
correlation::Study study_of_folder(const std::string& name);

/// The same study in a temporary folder, its tires on a coarse mesh if there is one, its
/// measurements written anew from the model itself as it is now. On a coarse mesh modes are
/// measured with their shapes and paired by these: there a label, which names the larger of two
/// parts of a shape, may change beside the truth, and the mode that had it is missed by 100 %.
correlation::Study fresh_twin(const std::string& name,
                              const std::optional<CoarseMesh>& mesh = std::nullopt);

/// The values of the variables in the model's own file: those a twin has to find.
DesignPoint true_point(const correlation::Study& study);

/// The program `latsch` has to stand beside the benchmark.
Fit fit(const correlation::Study& study, int workers);

/// bin/latsch
std::filesystem::path program();

}  // namespace latsch::benchmarks
