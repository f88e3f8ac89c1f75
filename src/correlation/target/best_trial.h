// SPDX-License-Identifier: Apache-2.0
// Finds the best trial in a journal: the least target among the trials that fulfill all
// constraints, or else the least violation. Only trials that the optimizer or a design of
// experiments requested count. A trial that was only started ahead of a search (asked_trials.h)
// does not, because it depends on the number of workers.
#pragma once

#include <optional>

#include "correlation/study/study.h"
#include "evaluation/journal/journal.h"

namespace latsch::correlation {

struct RatedTrial {
  DesignPoint point;
  double target = 0.0;
  double violation = 0.0;  // violation of the constraints on channels
  long row = -1;           // row in the journal, the first being 0; -1: not from a journal
};

/// True if point a violates its constraints less than point b, or if both fulfill them and a has
/// the smaller target.
bool is_better(const RatedTrial& a, const RatedTrial& b);

/// Returns every requested trial that succeeded, with its target, recomputed from the stored
/// channels, in the order of completion.
std::vector<RatedTrial> rated_trials(const Study& study, const Journal& journal);

/// True if the variables that the last stage does not free have the values at which it holds them.
/// Always true for a study without that information.
bool keeps_held(const Study& study, const DesignPoint& point);

/// Returns the rated trials within bounds and linear constraints that can be the best of the
/// present study (trial_ownership.h). If the study is in the state of its last stage, trials with
/// other values of the variables that this stage holds constant are left out.
std::vector<RatedTrial> rated_candidates(const Study& study, const Journal& journal);

/// Returns the best of rated_candidates(); of equal ones, the first.
/// Returns nullopt if there is none: no trial succeeded, or all were run for other measurements,
/// weights or bounds.
std::optional<RatedTrial> best_trial(const Study& study, const Journal& journal);

}  // namespace latsch::correlation
