// SPDX-License-Identifier: Apache-2.0
// Finds implausible numbers in a study, a model or a test, before computing time is spent on them.
#pragma once

#include <string>
#include <vector>

#include "correlation/study/study.h"
#include "experiment/language/usual_numbers.h"

namespace latsch::cli {

/// Warns of unusual numbers. Throws InputError for the first impossible one, after all warnings.
void reject_impossible(const std::vector<experiment::Finding>& found);
/// Checks the numbers of a study and its model's file; warns of unusual ones and throws InputError
/// for the first impossible one.
void reject_implausible(const correlation::Study& study);

/// Warns of all unusual and impossible numbers of a study and refuses none; used for a single
/// trial.
void warn_of_implausible(const correlation::Study& study);
/// Warns of limits that a model reached in a trial, except for those of limits_of_tests(), of which
/// a verb warns before the trial.
void warn_of_limits_met(const correlation::Study& study, const std::vector<std::string>& limits);
/// Checks the numbers of a model's file: warns of unusual ones, refuses impossible ones, and warns
/// if the model behaves implausibly beyond the data to which it was fitted.
void examine_model(const experiment::SpecimenKind& kind,
                   const Document& numbers,
                   const std::string& file);

}  // namespace latsch::cli
