// SPDX-License-Identifier: Apache-2.0
// The model of a study once more, on a finer mesh or in smaller steps: what these change, a fit
// takes into its numbers.
//
//   [refined]                       # evaluated once, where the numbers were found
//   model.belt.nodes = 200          # numbers of the model, as in a stage
//   model.tread.blocks = 20
//   [refined.test.slow]             # in place of the test of that name, written as [test.NAME]
//   file = "tests/slow_fine.toml"
//
//   [refined.simulator]             # in place of an outside program, written as [simulator]
//   command = ["python3", "{study}/beam.py", "beam.txt", "--elements", "80"]
//
// Intervals then reach to the numbers that the refined model would need for the same fit
// (analysis/refined_shift.h). Choose it so fine that one still finer changes little beside it: what
// is left beyond it nobody counts. It has no limit of time.
#pragma once

#include <optional>

#include "base/document.h"
#include "correlation/study/study.h"

namespace latsch::correlation {

/// [refined] of a study that is complete but for it; nullopt where there is none. Throws
/// InputError.
std::optional<Refinement> read_refinement(const Node& root,
                                          const Document& text,
                                          const Study& study,
                                          const experiment::Language& language,
                                          const Laboratory& laboratory);

/// The study as its refined model has it, with the journal STUDY.refined.latsch. It has to have
/// one.
Study refined(const Study& study);

/// "belt.nodes = 200, tread.blocks = 20; tests slow, fast"
std::string in_words(const Refinement& refinement);

}  // namespace latsch::correlation
