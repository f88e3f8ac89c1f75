// SPDX-License-Identifier: Apache-2.0
// A study from its start to its end: every stage (study_stages.h) from its design of experiments, if
// its search begins there, to the last step of its optimizer.
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "correlation/study/study.h"
#include "evaluation/executors/executor.h"
#include "evaluation/journal/journal.h"
#include "evaluation/schedule/scheduler.h"

namespace latsch::correlation {

struct Fit {
  Run run;
  std::optional<std::string> hopeless;  // why no point can succeed
};

/// One stage, or a study without any, from its start to its end.
Fit fit(const Study& stage, Executor& executor, Journal& journal, const RunOptions& options);

/// The stages as far as their journals know them, without evaluating.
std::vector<Fit> recorded_fit(const Study& study, const Journal& journal);

}  // namespace latsch::correlation
