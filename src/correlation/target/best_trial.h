// SPDX-License-Identifier: Apache-2.0
// The best trial in a journal, whoever asked for it, optimizer or design of experiments: the least
// target among those that fulfill all constraints, or the least violation. What nobody asked for,
// but ran ahead of a search, is none (asked_trials.h): it depends on how many workers there were.
#pragma once

#include <optional>

#include "correlation/study/study.h"
#include "evaluation/journal/journal.h"

namespace latsch::correlation {

struct RatedTrial {
  DesignPoint point;
  double target = 0.0;
  double violation = 0.0;  // of the constraints on channels
};

/// Less violation beyond what counts as fulfilled, or else a smaller target.
bool is_better(const RatedTrial& a, const RatedTrial& b);

/// Every trial asked for that succeeded with its target, computed anew from the stored channels, in
/// the order they finished.
std::vector<RatedTrial> rated_trials(const Study& study, const Journal& journal);

/// Whether the variables that the last stage does not free stand where it holds them; true of every
/// point of a study that does not know.
bool keeps_held(const Study& study, const DesignPoint& point);

/// nullopt where no trial succeeded. Of equals the first. A study as its last stage has it knows
/// which variables that stage holds: trials in which they stand elsewhere are no results.
std::optional<RatedTrial> best_trial(const Study& study, const Journal& journal);

}  // namespace latsch::correlation
