// SPDX-License-Identifier: Apache-2.0
#include "experiment/language/key_section.h"

namespace latsch::experiment {

const KeySection& pressure_keys();

const KeySection& load_deflection_keys() {
  static const KeySection section = {
      .heading = "Test \"load_deflection\": force over deflection",
      .about = R"md(
Vertical force over deflection or loaded radius.

Channels, one value for each position in the order of the file: "deflection", "loaded_radius"
(m), "force" (N), and for a tire that computes its patch "patch_length", "patch_width" (m),
"patch_area" (m^2). A loaded radius larger than that of the tire means no contact: all are 0. The
tire is pressed once through all positions, deeper and deeper: with friction the path is part of
the result.

The rig is tared with the wheel in the air, for every kind of tire: the weight of a belt (GRAVITY of
a .tir, `belt.gravity` of a flexible ring) is neither in its load nor in its forces, so a load is
that of the road on the tire.
)md",
      .sentences =
          {
              {"friction", "Friction of the tire with the ground."},
              {"deflections",
               "Deflections from first touch to which the tire is pressed; the test states these "
               "or `loaded_radii`. `{from = \"measurement.pressed\"}` takes them as they were "
               "measured."},
              {"loaded_radii",
               "Distances of the wheel center from the ground, instead of `deflections`; from a "
               "measurement likewise."},
          },
      .samples =
          {
              R"toml(kind = "load_deflection"
pressure = "2.6 bar"
friction = 0.8
deflections = ["5 mm", "10 mm"]
)toml",
              R"toml(kind = "load_deflection"
loaded_radii = ["310 mm", "300 mm"]
)toml",
          },
      .shared = {{"", pressure_keys}},
  };
  return section;
}

}  // namespace latsch::experiment
