// SPDX-License-Identifier: Apache-2.0
// Price of chains on the model, told before they start: trials, and the time they take as long as
// trials take what they took so far.
#pragma once

#include <string>

#include "correlation/study/study.h"
#include "evaluation/journal/journal.h"

namespace latsch::correlation {

/// Time of a trial above which chains on the model alone are no good choice, s.
constexpr double kShortTrial = 0.01;

/// Returns the median time of the journal's successful trials, s; NaN if there are none.
double median_trial_time(const Journal& journal);

/// Returns the price in one sentence or two; empty for the method surrogate. `seconds` is the time
/// of a trial.
std::string price_text(const Study& study, double seconds);

}  // namespace latsch::correlation
