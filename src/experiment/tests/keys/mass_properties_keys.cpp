// SPDX-License-Identifier: Apache-2.0
#include "experiment/language/key_section.h"

namespace latsch::experiment {

const KeySection& pressure_keys();

const KeySection& mass_properties_keys() {
  static const KeySection section = {
      .heading = "Test \"mass_properties\": mass, moments of inertia",
      .about = R"md(
Mass and moments of inertia of a tire: rubber and cords, neither rim nor air.

Channels of one value: "mass" (kg), "spin_inertia" and "diametral_inertia" (kg m^2), about the
spin axis and about a diameter of the wheel's center plane. The rim has to be subtracted from
measurements with a rim. Each channel is an objective by kind = "values", with slopes in
densities, thicknesses, cord areas and all other numbers in which a tire knows slopes.

Inflation widens the tire by some 0.1 to 1 %.
)md",
      .sentences = {},
      .samples =
          {
              R"toml(kind = "mass_properties"
pressure = "2.6 bar"
)toml",
          },
      .shared = {{"", pressure_keys}},
  };
  return section;
}

}  // namespace latsch::experiment
