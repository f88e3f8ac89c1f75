// SPDX-License-Identifier: Apache-2.0
// A study from its start to its end: every stage (study_stages.h) from its design of experiments,
// if its search begins there, to the last step of its optimizer.
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

struct Fit {
  Run run;
  std::optional<std::string> hopeless;  // why no point can succeed
  std::vector<OwnStage> own = {};       // an experiment each, by the stages before; recorded_fit()
};

/// One stage, or a study without any, from its start to its end.
Fit fit(const Study& stage, Executor& executor, Journal& journal, const RunOptions& options);

/// Where a stage has ended: its best point, with its recording.
struct StageEnd {
  DesignPoint point;
  Channels recording;
  std::vector<OwnStage> own = {};  // an experiment each, by this stage and those before
};

/// The recording of a point in a journal; empty where none of its trials succeeded.
Channels recording_at(const DesignPoint& point, const Journal& journal);

/// The end of stage k of a study behind the end of the stage before.
StageEnd end_of_stage(const Study& study,
                      int k,
                      const DesignPoint& best,
                      const Journal& journal,
                      const std::optional<StageEnd>& before);

/// Stage k of a study behind the end of the stage before, with noise as that tells it; of the first
/// stage, which has none before, nothing is known.
Study weighted_stage(const Study& study, int k, const std::optional<StageEnd>& before);

/// A study as its last stage has it, as far as the journals know: noise, the experiments that
/// count, the variables that move. The same where the last stage changes none of them. For
/// whoever looks at trials.
Study with_estimated_noise(const Study& study, const Journal& journal);

/// What the search of a study asks for first; nullopt where a journal decides that. One that has no
/// such trial knows no step of the search, which costs no reading of its channels to say.
std::optional<DesignPoint> first_point(const Study& study);

/// The stages as far as their journals know them, without evaluating.
/// `weighted`, where given, gets what the last of them has: take_stage().
std::vector<Fit> recorded_fit(const Study& study,
                              const Journal& journal,
                              Study* weighted = nullptr);

/// Of a fit that has reached its last stage: the experiments that are worse at the study's best
/// trial than an earlier stage had them, in words. `weighted` as recorded_fit() leaves it.
std::vector<std::string> spoiled_experiments(const Study& weighted,
                                             const std::vector<Fit>& fits,
                                             const Journal& journal);

}  // namespace latsch::correlation
