// SPDX-License-Identifier: Apache-2.0
// Test support: samples of the study of linear_study_testing.h, whose posterior is normal.
#pragma once

#include <filesystem>

#include "correlation/doe/linear_study_testing.h"
#include "correlation/posterior/posterior.h"
#include "evaluation/executors/inline_executor.h"

namespace latsch::correlation {

inline const StudyIdentity kLinearSprings{{"model", "linear springs"}};

/// Samples the study around kLinearFit with a new journal.
inline Result<Posterior> sampled_linear(const Study& study, const std::filesystem::path& file) {
  Journal journal = Journal::open(file, kLinearSprings);
  InlineExecutor executor(linear_trial);
  const auto found = sample_posterior(study, kLinearFit, executor, journal, {});
  return found ? *found : Result<Posterior>(Failure{"stopped"});
}

}  // namespace latsch::correlation
