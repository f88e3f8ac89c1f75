// SPDX-License-Identifier: Apache-2.0
// Marks in the journal that a run of a study has finished, with its intervals and its report, so
// that the same command repeats that result. Without this mark a second run would begin its
// intervals at the best trial that the first one found, run further trials around it, and end at
// another best trial.
#pragma once

#include <optional>

#include "correlation/study/study.h"
#include "evaluation/journal/journal.h"

namespace latsch::correlation {

/// Marks in the journal that a run has finished, with the point `begin` at which its intervals
/// began.
void mark_finished(const Study& study, const DesignPoint& begin, Journal& journal);

/// Returns the point at which the intervals of the finished run began, if the study has not changed
/// since and no trial was added.
std::optional<DesignPoint> finished_run(const Study& study, const Journal& journal);

}  // namespace latsch::correlation
