// SPDX-License-Identifier: Apache-2.0
// The model of a study on a finer mesh or with smaller steps. A fit shifts its values so that they
// compensate for the discretization error; the refined model shows by how much.
//
// Intervals are then widened to contain the values that the refined model would need for the same
// fit (analysis/refined_shift.h). The refinement should be so fine that a still finer model changes
// little in comparison, because errors of the refined model itself are not counted. Its trial has
// no time limit. The keys are in correlation/study/keys/refined_keys.cpp.
#pragma once

#include <optional>

#include "base/document.h"
#include "correlation/study/study.h"

namespace latsch::correlation {

/// Reads [refined] of a study that is otherwise complete; nullopt if there is none. Throws
/// InputError.
std::optional<Refinement> read_refinement(const Node& root,
                                          const Document& text,
                                          const Study& study,
                                          const experiment::Language& language,
                                          const Laboratory& laboratory);

/// Returns the study with its refined model and the journal STUDY.refined.latsch. The study must
/// have a refinement.
Study refined(const Study& study);

/// Returns the refinement as text, such as "belt.nodes = 200, tread.blocks = 20; tests slow, fast".
std::string in_words(const Refinement& refinement);

}  // namespace latsch::correlation
