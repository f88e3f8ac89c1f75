// SPDX-License-Identifier: Apache-2.0
// The study `latsch new` writes for a tire: which of its numbers vary, and between which bounds.
// Tires are those of studies/tires, built into the program.
#pragma once

#include <string>
#include <string_view>
#include <vector>

#include "base/document.h"

namespace latsch::cli {

struct TireTemplate {
  std::string_view name;  // "passenger_205_55R16"
  std::string_view text;  // the tire file
};

/// Generated from studies/tires/*.toml when the program is built.
const std::vector<TireTemplate>& tire_templates();

/// One number of the study, which may stand for several of the tire.
struct StarterVariable {
  std::string name;
  std::vector<std::string> paths;
  double initial = 0.0;  // Pa; the geometric mean of those the tire has
  double example = 0.0;  // of that value the example's measurements are made of it
};

/// The moduli that decide how stiff a tire is, as far as it has them: of the sidewalls' rubber, of
/// the carcass with its turnups, of the belts. Throws InputError where it has none of them.
std::vector<StarterVariable> starter_variables(const Document& tire);

/// The study file of that tire.
std::string study_template(const Document& tire);

}  // namespace latsch::cli
