// SPDX-License-Identifier: Apache-2.0
// Detects numbers of a study, a model or a test that no tire has, before time is spent on them.
#pragma once

#include <string>
#include <vector>

#include "correlation/study/study.h"
#include "experiment/language/usual_numbers.h"

namespace latsch::cli {

/// Warns of unusual numbers. Throws InputError for the first impossible one, after all warnings.
void reject_impossible(const std::vector<experiment::Finding>& found);
/// Does so for a study, with the notes on its model's file.
void reject_implausible(const correlation::Study& study);

/// Warns of all of them and refuses none, for a single trial.
void warn_of_implausible(const correlation::Study& study);
/// Warns of limits that a model met in a trial, but not of those of limits_of_tests(), of which a
/// verb warns before the trial.
void warn_of_limits_met(const correlation::Study& study, const std::vector<std::string>& limits);
/// Warns of and refuses numbers of the file of a model alone; also warns of its faults beyond the
/// data that it was fitted to.
void examine_model(const experiment::SpecimenKind& kind,
                   const Document& numbers,
                   const std::string& file);

}  // namespace latsch::cli
