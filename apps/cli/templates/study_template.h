// SPDX-License-Identifier: Apache-2.0
// The study that `latsch new` writes for a tire: which of its parameters are variables, and their
// ranges. The tires are those of studies/tires, contained in the program.
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

/// Returns the tires that the build generates from studies/tires/*.toml.
const std::vector<TireTemplate>& tire_templates();

/// A variable of the study, which may set several parameters of the tire.
struct StarterVariable {
  std::string name;
  std::vector<std::string> paths;
  double initial = 0.0;  // Pa; the geometric mean of these parameters in the tire
  /// ratio of the true value, with which the example's measurements are computed, to the initial
  /// value of the variable
  double example = 0.0;
};

/// Returns the moduli that determine the stiffness of a tire, if it has them: of the sidewalls'
/// rubber, of the carcass with its turnups, and of the belts. Throws InputError if the tire has
/// none of them.
std::vector<StarterVariable> starter_variables(const Document& tire);

/// Returns the study file of the given tire.
std::string study_template(const Document& tire);

}  // namespace latsch::cli
