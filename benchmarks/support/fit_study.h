// SPDX-License-Identifier: Apache-2.0
// Fits a study of studies/ from the beginning, in worker processes of the program, with a journal
// of its own.
#pragma once

#include <filesystem>
#include <string>

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

/// coarse: 15 columns, 30 sectors, a tenth of the cost of a trial.
enum class TwinMesh { as_described, coarse };

/// The same study in a temporary folder, its measurements written anew from the model itself as it
/// is now.
correlation::Study fresh_twin(const std::string& name, TwinMesh mesh = TwinMesh::as_described);

/// The program `latsch` has to stand beside the benchmark.
Fit fit(const correlation::Study& study, int workers);

/// bin/latsch
std::filesystem::path program();

}  // namespace latsch::benchmarks
