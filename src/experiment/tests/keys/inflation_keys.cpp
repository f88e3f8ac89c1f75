// SPDX-License-Identifier: Apache-2.0
#include "experiment/language/key_section.h"

namespace latsch::experiment {

const KeySection& inflation_keys() {
  static const KeySection section = {
      .heading = "Test \"inflation\": dimensions under pressures",
      .about = R"md(
Dimensions of a tire that is inflated on its rim, off the ground.

Channels, one value for each pressure in the order of the file: "pressure" (Pa), "outer_radius"
(m, half of the outside diameter), "section_width" (m, from sidewall to sidewall), and "growth"
(m), the outward displacement of the middle of the tread relative to zero pressure. Growth is
mostly the stretch of belt and carcass: it identifies their moduli, on which frequencies hardly
depend.
)md",
      .sentences =
          {
              {"pressures",
               "Pressures at which the tire is measured; `{from = \"measurement.inflated\"}` takes "
               "those of its channel pressure.",
               "the tire's own"},
              {"speed",
               "Speed of a tire that spins: a speed of rotation such as \"90 rad/s\", or the speed "
               "of a wheel that rolls on the outer radius of the tire inflated at rest, such as "
               "\"100 km/h\". The growth then includes that by rotation, and the channel \"spin\" "
               "(rad/s) is recorded. Without it the tire does not spin."},
          },
      .samples =
          {
              R"toml(kind = "inflation"
pressures = ["0.5 bar", "2.6 bar"]
speed = "100 km/h"
)toml",
          },
  };
  return section;
}

}  // namespace latsch::experiment
