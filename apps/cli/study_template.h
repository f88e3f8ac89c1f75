// SPDX-License-Identifier: Apache-2.0
// The files `latsch new` writes. Tires are those of studies/tires, built into the program.
#pragma once

#include <string>
#include <string_view>
#include <vector>

namespace latsch::cli {

struct TireTemplate {
  std::string_view name;  // "passenger_205_55R16"
  std::string_view text;  // the tire file
};

/// Generated from studies/tires/*.toml when the program is built.
const std::vector<TireTemplate>& tire_templates();

/// The study file, with variables that the tire has.
std::string study_template(std::string_view tire);

/// The example measurements, published for a 205/55R16 at 2.4 bar.
std::string_view stiffness_template();
std::string_view modes_template();

}  // namespace latsch::cli
