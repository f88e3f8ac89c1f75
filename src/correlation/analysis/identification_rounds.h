// SPDX-License-Identifier: Apache-2.0
// An identification of a study, from its first round to its last: which trials each round needs,
// where they are kept, and in what form.
//
// Rounds that take derivatives and refit all variables keep whole recordings in the journal of the
// study. Profiles and the cross-validation keep their trials reduced (refit_trials.h) where the
// recordings bring slopes, and in the journal of the study where they do not.
#pragma once

#include <functional>

#include "correlation/analysis/identifiability.h"
#include "correlation/analysis/refit_trials.h"
#include "evaluation/schedule/scheduler.h"

namespace latsch::correlation {

inline constexpr long kMostIdentificationTrials = 100'000;  // one optimizer has no more

/// Returns the share of the trials of one optimizer that is done, from 0 to 1; 0 if nobody knows.
using Share = std::function<double()>;

/// Evaluates, or reads, until the optimizer wants nothing more; false where that was stopped.
/// `refits`: keeps and scores the trials if they are reduced; nullptr: the journal of the study
/// keeps them.
using Drive = std::function<bool(Optimizer&, RefitTrials* refits, const Share& share)>;

/// Reads what is known already.
Drive reading(const Study& study, const Journal& journal);

/// The trials of one identification.
struct IdentificationTrials {
  const Study& study;
  const Journal& journal;
  Journal* writable;  // `journal` again; nullptr if no trial may be added
  Drive drive;

  RefitTrials refits(const RowGroups& groups, const Linearization& at) const;
};

IdentificationOptions options_for(const Study& study, Depth depth);

/// Drives all rounds. False where driving was stopped; `result` then holds what is complete.
bool analyze(const IdentificationTrials& trials, Identifiability& result);

}  // namespace latsch::correlation
