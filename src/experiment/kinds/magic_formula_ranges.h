// SPDX-License-Identifier: Apache-2.0
// Default bounds of the coefficients of the Magic Formula, used if a study states none. They
// contain the values of car and race tires with a margin. The ranges for side force and aligning
// moment contained all fits of measured race tires. Those for the longitudinal force and for
// combined slip are wider than the published sets from which they were chosen (parameter files of
// formula 5.2, 6.1 and 6.2 that come with multibody programs).
#pragma once

#include <optional>
#include <string_view>

#include "experiment/language/specimen.h"

namespace latsch::experiment {

/// Returns nullopt for a parameter that is not fitted, such as a radius or a nominal load.
std::optional<UsualRange> usual_range_of(std::string_view coefficient);

}  // namespace latsch::experiment
