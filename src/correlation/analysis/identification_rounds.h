// SPDX-License-Identifier: Apache-2.0
// Runs an identification of a study from its first round to its last: determines which trials each
// round needs, and in which journal and form they are stored.
//
// Rounds that compute derivatives or refit all variables store whole recordings in the journal of
// the study. Profiles and the cross-validation store reduced trials (refit_trials.h) if recordings
// contain derivatives, and whole trials in the journal of the study otherwise.
#pragma once

#include <functional>
#include <string>

#include "correlation/analysis/identifiability.h"
#include "correlation/analysis/refit_trials.h"
#include "evaluation/schedule/scheduler.h"

namespace latsch::correlation {

inline constexpr long kMostIdentificationTrials = 100'000;  // limit on the trials of one optimizer

/// The present work of an analysis and how far it is.
struct WorkDone {
  std::string work;    // such as "profiles"
  double share = 0.0;  // share of the optimizer's trials that are done, from 0 to 1; 0: unknown
  long left = 0;       // if the share is unknown: estimated number of trials to come, 0: unknown
};
using AsksWorkDone = std::function<WorkDone()>;

/// Evaluates trials, or reads stored ones, until the optimizer proposes no more; returns false if
/// it was stopped. `refits` stores and scores reduced trials; nullptr: whole trials are stored in
/// the journal of the study.
using Drive = std::function<bool(Optimizer&, RefitTrials* refits, const AsksWorkDone&)>;

/// Returns a function that reads stored trials but runs none.
Drive reading(const Study& study, const Journal& journal);

/// The trials of one identification and the means to run them.
struct IdentificationTrials {
  const Study& study;
  const Journal& journal;
  Journal* writable;  // `journal` if trials may be added to it, else nullptr
  Drive drive;

  RefitTrials refits(const RowGroups& groups, const Linearization& at) const;
};

IdentificationOptions options_for(const Study& study, Depth depth);

/// Runs all rounds. Returns false if it was stopped; `result` then contains the completed parts.
bool analyze(const IdentificationTrials& trials, Identifiability& result);

}  // namespace latsch::correlation
