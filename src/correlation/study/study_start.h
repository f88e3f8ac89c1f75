// SPDX-License-Identifier: Apache-2.0
// Start point and initial knowledge of a study's search.
//
//   [optimizer]
//   start = "values"              # the initial values, knowing nothing
//   start = "journal"             # the best point of all earlier trials, which the method observes
//   start_journal = "old.latsch"  # of another journal of the same model too: they are taken over
//   start = "basins"              # the lowest minimum of the study's [doe], whose points the
//                                 # method observes; missing points are evaluated first
//   starts = 1                    # number of minima to begin at, from the lowest to the highest,
//                                 # idle workers with the next; the best of all is the result
//
// With several starts, a run receives no points better than its own start, because it would then
// leave its basin. It receives the points nearest to the start, as many as two quadratic models
// need.
//
// A journal grows while a search runs, so a mark stores the number of trials at the beginning of
// the search. Resuming, and drawing the report, begin with the same trials. The mark belongs to the
// study as written, without [run]: a changed study begins anew with all trials. The order in which
// trials came does not matter.
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
