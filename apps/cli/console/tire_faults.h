// SPDX-License-Identifier: Apache-2.0
// Warns of faults of a Magic Formula tire beyond its data, with the coefficients that cause them.
#pragma once

#include <string>

#include "correlation/study/study.h"

namespace latsch::cli {

/// Warns of the tire of a study at a point, over the states of its fitted tests. `of_what` precedes
/// each sentence: "the best trial so far, ".
void warn_beyond_data(const correlation::Study& study,
                      const DesignPoint& point,
                      const std::string& of_what = "");

/// Warns of the tire of a file, over its ranges.
void warn_beyond_data(const experiment::SpecimenKind& kind,
                      const Document& numbers,
                      const std::string& file);

}  // namespace latsch::cli
