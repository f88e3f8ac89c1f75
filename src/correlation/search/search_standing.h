// SPDX-License-Identifier: Apache-2.0
// States, in words and counts, whether the journal holds a best point of the present study.
// Everything that displays a best point uses it.
#pragma once

#include <string>

#include "correlation/study/study.h"
#include "correlation/target/trial_ownership.h"
#include "evaluation/journal/journal.h"

namespace latsch::correlation {

/// Counts every row of a journal that belongs to the study. Computes all targets.
TrialCounts count_trials(const Study& study, const Journal& journal);

/// Returns the reason why the trial with the least target is not the best point of the present
/// study, with the counts and the next step; empty if it is, or if no trial has a target. The
/// journal must belong to the study (Journal::read). For a journal without marks of ownership the
/// search is replayed, which can take seconds.
std::string why_no_best(const Study& study, const Journal& journal);

/// Returns the same reason for a journal whose trials have been counted. `may_have_ended` is false
/// if the search was replayed and had not ended; it matters only if the ownership of the trials is
/// not known.
std::string why_no_best(const Study& study,
                        const TrialCounts& counts,
                        const TrialOwnership& ownership,
                        bool may_have_ended);

/// Throws InputError with why_no_best().
void require_best(const Study& study, const Journal& journal);

}  // namespace latsch::correlation
