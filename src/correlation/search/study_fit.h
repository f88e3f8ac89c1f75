// SPDX-License-Identifier: Apache-2.0
// Runs a study from its start to its end: every stage (study_stages.h) from its design of
// experiments, if its search begins with one, to the last step of its optimizer.
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
  std::optional<std::string> hopeless;  // reason why no point can succeed
  std::vector<OwnStage> own = {};       // one for each experiment, from the earlier stages; set by
                                        // recorded_fit()
};

/// Runs one stage, or a study without stages, from its start to its end.
Fit fit(const Study& stage, Executor& executor, Journal& journal, const RunOptions& options);

/// End of a stage: its best point with its recording.
struct StageEnd {
  DesignPoint point;
  Channels recording;
  std::vector<OwnStage> own = {};  // one for each experiment, from this stage and the earlier ones
};

/// Returns the recording of a point in a journal; empty if none of its trials succeeded.
Channels recording_at(const DesignPoint& point, const Journal& journal);

/// Returns the end of stage k of a study, given the end of the stage before.
StageEnd end_of_stage(const Study& study,
                      int k,
                      const DesignPoint& best,
                      const Journal& journal,
                      const std::optional<StageEnd>& before);

/// Returns stage k of a study with the noise that the end of the stage before determines. The first
/// stage has no stage before, so its noise is not known.
Study weighted_stage(const Study& study, int k, const std::optional<StageEnd>& before);

/// Returns a study in the state of its last stage, as far as the journals know: noise, the
/// experiments that count, the variables that move. The study is unchanged if the last stage
/// changes none of them. Everything that displays trials uses this study.
Study with_estimated_noise(const Study& study, const Journal& journal);

/// Returns the first point that the search of a study will evaluate; nullopt if that depends on a
/// journal. A journal without a trial of that point contains no step of the search; this check does
/// not read channels.
std::optional<DesignPoint> first_point(const Study& study);

/// Returns the stages as far as their journals contain them, without evaluating. `weighted`, if
/// given, is updated to the last of these stages: take_stage().
std::vector<Fit> recorded_fit(const Study& study,
                              const Journal& journal,
                              Study* weighted = nullptr);

/// For a fit that has reached its last stage, returns in words the experiments whose error at the
/// study's best trial is worse than after an earlier stage. `weighted` is as recorded_fit() leaves
/// it.
std::vector<std::string> spoiled_experiments(const Study& weighted,
                                             const std::vector<Fit>& fits,
                                             const Journal& journal);

}  // namespace latsch::correlation
