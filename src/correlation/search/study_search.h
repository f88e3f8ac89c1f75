// SPDX-License-Identifier: Apache-2.0
// Starts the optimizer of a study with its initial knowledge (study_start.h): nothing, the trials
// of a journal, or a design of experiments.
#pragma once

#include <memory>

#include "correlation/study/study.h"
#include "evaluation/journal/journal.h"
#include "optimization/problem/optimizer.h"

namespace latsch::correlation {

/// Returns the optimizer of the study with its initial knowledge. Takes over trials of another
/// journal, and marks the start in the journal if it is not marked yet. Throws InputError if the
/// other journal belongs to another model.
std::unique_ptr<Optimizer> begin_search(const Study& study, Journal& journal);

/// Returns the optimizer in the state at its start; nullptr if it never started.
std::unique_ptr<Optimizer> begun_search(const Study& study, const Journal& journal);

}  // namespace latsch::correlation
