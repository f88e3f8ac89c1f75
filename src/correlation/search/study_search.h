// SPDX-License-Identifier: Apache-2.0
// The optimizer of a study with what it knows at its start (study_start.h): nothing, the trials of
// a journal, or a design of experiments.
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
