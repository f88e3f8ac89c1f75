// SPDX-License-Identifier: Apache-2.0
// Between which values coefficients of the Magic Formula are looked for unless a study says other
// bounds: what tires of cars and race cars have, with room to spare. Those of side force and
// aligning moment have held fits of measured race tires, those of the longitudinal force and of
// combined slip are wider than the published sets beside which they were chosen (parameter files of
// formula 5.2, 6.1 and 6.2 that come with multibody programs).
#pragma once

#include <optional>
#include <string_view>

#include "experiment/language/specimen.h"

namespace latsch::experiment {

/// nullopt for a parameter that is no coefficient to be fitted: a radius, a nominal load.
std::optional<UsualRange> usual_range_of(std::string_view coefficient);

}  // namespace latsch::experiment
