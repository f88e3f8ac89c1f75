// SPDX-License-Identifier: Apache-2.0
// Fits one stage of a study, or a study without stages: from its design of experiments, if its
// search begins with one, to the last step of its optimizer. stage_runs.h runs all stages.
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "correlation/search/own_stages.h"
#include "correlation/study/study.h"
#include "evaluation/executors/executor.h"
#include "evaluation/journal/journal.h"
#include "evaluation/schedule/scheduler.h"
#include "measurement/channels.h"

namespace latsch::correlation {

/// The steps of one stage's search and its end.
struct Fit {
  Run run;  // every step with its score, the best one, and the reason of the end
  std::optional<std::string> hopeless;  // reason why no point can succeed
  /// one entry for each experiment, with its least error in earlier stages; set by run_stages()
  std::vector<OwnStage> own = {};
};

/// Fits one stage from its start to its end.
Fit fit(const Study& stage, Executor& executor, Journal& journal, const RunOptions& options);

/// Repeats the fit of one stage from its journal as far as the journal contains it, without
/// evaluating. Returns nullopt if the search never started.
std::optional<Fit> recorded_fit(const Study& stage, const Journal& journal);

/// Returns the recording of a point in a journal; empty if none of its trials succeeded.
Channels recording_at(const DesignPoint& point, const Journal& journal);

}  // namespace latsch::correlation
