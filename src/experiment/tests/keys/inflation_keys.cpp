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
          },
      .samples =
          {
              R"toml(kind = "inflation"
pressures = ["0.5 bar", "2.6 bar"]
)toml",
          },
  };
  return section;
}

}  // namespace latsch::experiment
