// SPDX-License-Identifier: Apache-2.0
// Says whether the journal of a study holds a best point of the study as it stands, in words and
// counts, for everything that speaks of a best point.
#pragma once

#include <string>

#include "correlation/study/study.h"
#include "correlation/target/trial_ownership.h"
#include "evaluation/journal/journal.h"

namespace latsch::correlation {

/// Counts every row of a journal that belongs to the study. Computes all targets.
TrialCounts count_trials(const Study& study, const Journal& journal);

/// Returns why the least target in the journal is no best point of the study as it stands, with the
/// counts and the next step; empty if it is one, or if no trial has a target. The journal belongs
/// to the study (Journal::read). The search of a journal without marks of ownership is replayed,
/// which can take seconds.
std::string why_no_best(const Study& study, const Journal& journal);

/// The words for a journal whose trials are counted. `may_have_ended` is false if its search was
/// replayed and has not ended, which matters only if the ownership of its trials is not known.
std::string why_no_best(const Study& study,
                        const TrialCounts& counts,
                        const TrialOwnership& ownership,
                        bool may_have_ended);

/// Throws InputError with why_no_best().
void require_best(const Study& study, const Journal& journal);

}  // namespace latsch::correlation
