// SPDX-License-Identifier: Apache-2.0
// Writes what a selection found: a study that moves the kept variables alone, and a table of all
// candidates.
//
// The study is the text of the original with its comments. A stage that frees the kept variables is
// added at its end, so the others stay at their initial values; those that are dropped to another
// value get it as `initial`.
#pragma once

#include <filesystem>
#include <string>

#include "correlation/selection/study_selection.h"

namespace latsch::correlation {

/// Returns STUDY.selected.toml beside the study.
std::filesystem::path selected_study_file(const Study& study);
/// Returns STUDY.selection.csv beside the study.
std::filesystem::path selection_table_file(const Study& study);

/// Returns the text of the study that holds the dropped variables, or a Failure that says why it
/// cannot be written and what to write instead.
Result<std::string> selected_study_text(const Study& study, const StudySelection& selected);

/// Writes one line for each variable of each candidate: its name, unit, 1 if it is kept, the round
/// that dropped it, the rise of -2 log L, its value, and the ends of its interval.
void write_selection_table(const Study& study,
                           const StudySelection& selected,
                           const std::filesystem::path& file);

}  // namespace latsch::correlation
