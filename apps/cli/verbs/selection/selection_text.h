// SPDX-License-Identifier: Apache-2.0
// Prints the results of `latsch select`: the path of models, the fate of each candidate, and models
// that the values do not tell apart.
#pragma once

#include "correlation/selection/study_selection.h"

namespace latsch::cli {

/// Prints the models of the path: their number of variables, the rise that each drop was expected
/// to cause and caused, and the criterion.
void print_path(const correlation::StudySelection& selected);

/// Prints each candidate: kept or dropped in which round, its rise, value and interval, and the
/// recording that would hold a dropped one.
void print_candidates(const correlation::Study& study, const correlation::StudySelection& selected);

/// Prints and warns about what the choice rests on.
void print_ground(const correlation::Study& study, const correlation::StudySelection& selected);

/// Prints the models within 2 of the best criterion side by side. `errors` holds, for each of them,
/// the error of each predicted experiment, named by `experiments`; empty if there is none.
void print_rivals(const correlation::Study& study,
                  const correlation::StudySelection& selected,
                  const std::vector<std::string>& experiments,
                  const std::vector<std::vector<double>>& errors);

/// Adds all of it to the JSON answer.
void answer_selection(const correlation::Study& study,
                      const correlation::StudySelection& selected,
                      const std::vector<std::string>& experiments,
                      const std::vector<std::vector<double>>& errors);

}  // namespace latsch::cli
