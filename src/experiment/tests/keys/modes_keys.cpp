// SPDX-License-Identifier: Apache-2.0
#include "experiment/language/key_section.h"

namespace latsch::experiment {

const KeySection& pressure_keys();

const KeySection& modes_keys() {
  static const KeySection section = {
      .heading = "Test \"modes\": frequencies and shapes",
      .about = R"md(
Vibration modes of a tire with its rim held, off the ground or standing on it.

Channels, one value for each mode: "frequency" (Hz), and "n", "type" and "phase" as
numbers; "shape" at the points; "damping" (of critical) if the model has it;
on the ground one value of "deflection", "loaded_radius" (m) and "force" (N) if the model
computes them.
)md",
      .sentences =
          {
              {"load",
               "Load of the standing tire; the mean of the channel Fz if it comes from a "
               "measurement. Without `load` and `deflection` the tire is in the air."},
              {"deflection", "Deflection of the standing tire, instead of `load`."},
              {"friction", "Friction of the tire with the ground."},
              {"camber", "Inclination of the wheel about x, top to the right."},
              {"count",
               "Number of modes computed, the lowest ones. `{from = \"measurement.modes\"}` "
               "computes 8 more than it has frequencies."},
              {"points",
               "Points in the wheel frame, on the undeformed tire, at which shapes are recorded; "
               "`{from = \"measurement.shapes\"}` takes its x, y, z. Without points no shapes are "
               "recorded."},
          },
      .samples =
          {
              R"toml(kind = "modes"
load = "4 kN"
pressure = "2.6 bar"
friction = 0.8
camber = "2 deg"
count = 12
points = [["0 mm", "50 mm", "310 mm"]]
)toml",
              R"toml(kind = "modes"
deflection = "15 mm"
)toml",
          },
      .shared = {{"", pressure_keys}},
  };
  return section;
}

}  // namespace latsch::experiment
