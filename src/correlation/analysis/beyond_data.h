// SPDX-License-Identifier: Apache-2.0
// Faults of a study's tire beyond the data, and which free coefficients the data do not tell, in
// words for terminal, page and report. The lattice and its rows are those of
// models/magic_formula/sanity.h, the levels those of coefficient_levels.h.
#pragma once

#include <string>
#include <vector>

#include "correlation/study/study.h"
#include "experiment/language/specimen.h"

namespace latsch::correlation {

/// "PDY2 = +0.5 at its bound: lateral friction rises with load: ...": `study` and `point`, if
/// given, tell which numbers stand at their bounds.
std::string in_words(const experiment::FaultBeyondData& fault,
                     const Study* study = nullptr,
                     const DesignPoint& point = {});

/// The faults of the tire of a study at a point, over the states of its fitted tests; a sentence
/// each. Empty for a model that is no Magic Formula.
std::vector<std::string> faults_beyond_data(const Study& study, const DesignPoint& point);

/// A sentence for every free coefficient whose data hold too few levels.
std::vector<std::string> untold_in_words(const Study& study);

}  // namespace latsch::correlation
