// SPDX-License-Identifier: Apache-2.0
#include "experiment/language/key_section.h"

namespace latsch::experiment {

const KeySection& pressure_keys();
const KeySection& rolling_state_keys();

const KeySection& rolling_footprint_keys() {
  static const KeySection section = {
      .heading = "Test \"rolling_footprint\": patch of a finite-element tire that rolls",
      .about = R"md(
Pressure, shear, sliding and grip in the patch of a finite-element tire that rolls steadily, as
sensors in the ground read them. `latsch test --html` draws the patch of every state, and
`--details FILE` writes its points as a table: "state", "line" (from 0 at the right edge), "x",
"y", "pressure", "shear_x", "shear_y", "slide_x", "slide_y", "grip", "power" (W/m^2).

Channels, one value for each state, axes W (ISO): "alpha", "gamma" (rad), "kappa" (1), "Vx" (m/s);
"load" (N), "length", "width" (m), "area" (m^2) of the points in contact, each of which stands for
a rectangle; "mean_pressure", "peak_pressure" (Pa), "grip_level" (1, the used share of the
friction), "sticking" (share of the load), "sliding_speed" (m/s, mean weighted by pressure),
"loss_friction" (W). For `sensors`, all of one state and then those of the next: "pressure",
"shear_x", "shear_y" (Pa, on the tire), "slide_x", "slide_y" (m/s, of the tread over the ground,
weighted by pressure), "grip" (1, |t|/(mu p)), "sensor_x", "sensor_y" (m).

The tire rolls on its own mesh, which test "footprint" refines. On a coarse mesh some lines of
points carry too much and others nothing, so that the area may be half that of "footprint" and the
pressures twice its own. Length and width reach to the edges of the rectangles; those of test
"rolling" reach to their centers.
)md",
      .sentences =
          {
              {"sensor", "Side of the squares in which the ground measures."},
              {"sensors",
               "Centers of some squares, x forward, y left of the contact center.",
               "none"},
          },
      .samples =
          {
              R"toml(kind = "rolling_footprint"
load = "4 kN"
speed = "60 km/h"
friction = 1.0
pressure = "2.6 bar"
alpha = ["0 deg", "1 deg"]
sensor = "10 mm"
sensors = [["0 mm", "0 mm"], ["30 mm", "20 mm"]]
)toml",
          },
      .shared = {{"", rolling_state_keys}, {"", pressure_keys}},
  };
  return section;
}

}  // namespace latsch::experiment
