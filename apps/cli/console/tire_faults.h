// SPDX-License-Identifier: Apache-2.0
// Warns if a Magic Formula tire behaves implausibly beyond the data to which it was fitted, and
// names the coefficients that cause it.
#pragma once

#include <string>

#include "correlation/study/study.h"

namespace latsch::cli {

/// Checks the tire of a study at a design point, over the range of states in its fitted tests.
/// `of_what` precedes each warning: "the best trial so far, ".
void warn_beyond_data(const correlation::Study& study,
                      const DesignPoint& point,
                      const std::string& of_what = "");

/// Checks the tire of a model's file over the validity ranges that it states.
void warn_beyond_data(const experiment::SpecimenKind& kind,
                      const Document& numbers,
                      const std::string& file);

}  // namespace latsch::cli
