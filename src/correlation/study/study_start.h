// SPDX-License-Identifier: Apache-2.0
// Start point and initial knowledge of a study's search.
//
// With several starts, a run receives no points better than its own start, because it would then
// leave its basin. It receives the points nearest to the start, as many as two quadratic models
// need.
//
// A journal grows while a search runs, so a mark stores the number of trials at the beginning of
// the search. Resuming, and drawing the report, begin with the same trials. The mark belongs to the
// study as written, without [run]: a changed study begins anew with all trials. The order in which
// trials came does not matter.
//
// The keys are in correlation/study/keys/start_keys.cpp.
#pragma once

#include <filesystem>
#include <string>

#include "base/document.h"
#include "correlation/study/study.h"

namespace latsch::correlation {

/// Reads the keys above. Throws InputError.
StartSettings read_start(const Node& table, const std::filesystem::path& folder, bool has_design);

/// Returns a text for a person: "the best of 40 earlier trials, which it knows"; empty for the
/// initial values.
std::string in_words(const StartSettings& start);

}  // namespace latsch::correlation
