// SPDX-License-Identifier: Apache-2.0
// The optimizer of a study with what it knows at its start (study_start.h): nothing, the trials of a
// journal, or a design of experiments.
//
// A journal grows while a search runs, so a mark keeps how many trials there were when it began: to
// resume, and to draw the report, is to begin with the same ones. The mark belongs to the study as
// written, without [run]: a study that is changed begins anew with all there is. The order in which
// trials came does not matter.
#pragma once

#include <memory>

#include "correlation/study/study.h"
#include "evaluation/journal/journal.h"
#include "optimization/problem/optimizer.h"

namespace latsch::correlation {

/// The optimizer of the study with what it knows. Takes trials of another journal over and marks
/// the start in the journal, where it has not been. Throws InputError where the other journal is of
/// another model.
std::unique_ptr<Optimizer> begin_search(const Study& study, Journal& journal);

/// The same as it began; nullptr where it never did.
std::unique_ptr<Optimizer> begun_search(const Study& study, const Journal& journal);

}  // namespace latsch::correlation
