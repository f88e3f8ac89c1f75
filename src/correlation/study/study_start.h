// SPDX-License-Identifier: Apache-2.0
// Start points and initial knowledge of a study's search.
//
// If there are several starts, a run receives no points better than its own start, because it would
// then leave its basin. It receives the points nearest to the start, as many as two quadratic
// models need. A journal grows while a search runs, so a mark stores the number of trials at the
// beginning of the search: resuming it and drawing its report use the same trials. The mark belongs
// to the study as written, without [run]; a changed study begins again, with all trials. The order
// of the trials in the journal does not matter. The keys are in
// correlation/study/keys/start_keys.cpp.
#pragma once

#include <filesystem>
#include <string>

#include "base/document.h"
#include "correlation/study/study.h"

namespace latsch::correlation {

/// Reads the keys of the start. Throws InputError.
StartSettings read_start(const Node& table, const std::filesystem::path& folder, bool has_design);

/// Returns the start in words, such as "the best of 40 earlier trials, which it knows"; empty for
/// the initial values.
std::string in_words(const StartSettings& start);

}  // namespace latsch::correlation
