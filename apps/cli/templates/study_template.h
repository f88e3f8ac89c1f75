// SPDX-License-Identifier: Apache-2.0
// The study that `latsch new` writes for a tire: which of its numbers vary, and in which ranges.
// The tires are those of studies/tires, contained in the program.
#pragma once

#include <string>
#include <string_view>
#include <vector>

#include "base/document.h"

namespace latsch::cli {

struct TireTemplate {
  std::string_view name;  // "passenger_205_55R16"
  std::string_view text;  // content of the tire file
};

/// Generated from studies/tires/*.toml when the program is built.
const std::vector<TireTemplate>& tire_templates();

/// One variable of the study, which may stand for several numbers of the tire.
struct StarterVariable {
  std::string name;
  std::vector<std::string> paths;
  double initial = 0.0;  // Pa; the geometric mean of the tire's numbers
  double example = 0.0;  // factor of that value with which the example's measurements are computed
};

/// Returns the moduli that determine the stiffness of a tire, as far as it has them: of the
/// sidewalls' rubber, of the carcass with its turnups, of the belts. Throws InputError if it has
/// none of them.
std::vector<StarterVariable> starter_variables(const Document& tire);

/// Returns the study file of the given tire.
std::string study_template(const Document& tire);

}  // namespace latsch::cli
