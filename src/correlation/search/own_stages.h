// SPDX-License-Identifier: Apache-2.0
// Finds the stage of a study that fitted an experiment best, and whether the final result is worse.
//
// A stage that fits one experiment leaves an error e_0 in the experiment's own measure, the mean
// |d|^k to the power 1/k (an RMS for k = 2). A later stage that also fits other experiments may
// increase this error to e, which counts as worse if
//   e > 1.05 e_0,   e > noise that the study states,   e - e_0 > 1e-6 of what counts as 100 %.
// The own stage of an experiment is the one with the least error among the stages before the last
// in which the experiment is fitted and whose model is that of the study. A coarse mesh is another
// model.
#pragma once

#include <limits>
#include <string>
#include <vector>

#include "correlation/study/study.h"
#include "measurement/channels.h"

namespace latsch::correlation {

/// The stage that ended with the least error of one experiment.
struct OwnStage {
  /// Name of the stage; empty if no stage fitted the experiment.
  std::string stage = {};
  /// Error at the end of that stage in the experiment's own measure, 1 = 100 %.
  double error = std::numeric_limits<double>::infinity();
  double rms = std::numeric_limits<double>::infinity();  // rms_error() at the end of that stage

  bool is_known() const { return !stage.empty(); }
};

/// Updates `own` with the end of stage k. `own` has one entry for each experiment of the study, or
/// is empty.
void add_stage_end(const Study& study,
                   int k,
                   const Channels& recording,
                   std::vector<OwnStage>& own);

/// True if an error has become worse than that of the experiment's own stage, by the rule at the
/// head of this file.
bool is_spoiled(const StudyExperiment& experiment, const OwnStage& own, double error);

/// Returns a sentence such as "Fy has an RMS of 3.60 %, 2.10 % at the end of its own stage
/// Fy_conditions".
std::string spoiled_in_words(const StudyExperiment& experiment, const OwnStage& own, double error);

/// Returns spoiled_in_words() for every experiment whose error in a recording is worse than that of
/// its own stage.
std::vector<std::string> spoiled_experiments(const Study& study,
                                             const std::vector<OwnStage>& own,
                                             const Channels& recording);

}  // namespace latsch::correlation
