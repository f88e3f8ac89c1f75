// SPDX-License-Identifier: Apache-2.0
// Finds where a study's tire behaves implausibly beyond the data, and free coefficients that the
// data do not determine, and describes both in words for terminal, page and report. The states that
// are examined are those of models/magic_formula/sanity/sanity.h, the levels those of
// coefficient_levels.h.
#pragma once

#include <string>
#include <vector>

#include "correlation/study/study.h"
#include "experiment/language/specimen.h"

namespace latsch::correlation {

/// Returns the fault in words, such as "PDY2 = +0.5 at its bound: lateral friction rises with load:
/// ...". `study` and `point`, if given, show which numbers are at their bounds.
std::string in_words(const experiment::FaultBeyondData& fault,
                     const Study* study = nullptr,
                     const DesignPoint& point = {});

/// Returns the faults of the tire of a study at a point, over the states of its fitted tests; one
/// sentence each. The list is empty if the model is no Magic Formula.
std::vector<std::string> faults_beyond_data(const Study& study, const DesignPoint& point);

/// Returns a sentence for every free coefficient that the data cannot determine because a test
/// condition has too few levels.
std::vector<std::string> untold_in_words(const Study& study);

}  // namespace latsch::correlation
