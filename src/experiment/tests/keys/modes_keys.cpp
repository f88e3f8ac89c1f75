// SPDX-License-Identifier: Apache-2.0
#include "experiment/language/key_section.h"

namespace latsch::experiment {

const KeySection& pressure_keys();

const KeySection& modes_keys() {
  static const KeySection section = {
      .heading = "Test \"modes\": frequencies and shapes",
      .about = R"md(
Vibration modes of a tire with its rim held, off the ground or standing on it; of a
finite-element tire off the ground also while it spins, and with a rim that moves.

Channels, one value for each mode: "frequency" (Hz), and as numbers "n", the waves around the
tire, "type" (0 torsional, 1 lateral, 2 radial, 3 other) and "phase" (of a standing tire 1
symmetric and 2 antisymmetric to the axle's plane, else 0); "shape" at the points; "damping" (of critical) of a flexible ring, and of a finite-element
tire if the key `damping` is true;
on the ground one value of "deflection", "loaded_radius" (m) and "force" (N) if the model
computes them.

If the tire spins, its rim moves or its standing-wave speed is asked for: "frequency" as seen
from axes that do not spin, "frequency_on_tire" of a sensor that spins along, "sense" (1 with the
spin, -1 against it, 0 neither), "shape_later", the shape a quarter of a period later; one value of
"spin" (rad/s), "outer_radius" (m), and "standing_wave_speed" (rad/s) with "standing_wave_n".
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
              {"speed",
               "Speed of a finite-element tire that spins in the air: a speed of rotation such as "
               "\"90 rad/s\", or the speed of a wheel that rolls on the outer radius of the tire "
               "inflated at rest, such as \"100 km/h\". Without it the tire does not spin."},
              {"rim",
               "`held`: the rim does not move (default). `free`: it is a rigid body that only the "
               "tire holds, as on soft cords; motions of the whole wheel below 0.5 Hz are left "
               "out. `rigid`: it is a rigid body on the springs that `[rim]` of the tire file "
               "states. Mass and inertias come from there, too."},
              {"standing_wave",
               "`true` computes the speed of rotation at which a wave stands still beside the "
               "wheel, among waves of at least three sectors of the mesh."},
              {"damping",
               "`true`: rubber and layers of a finite-element tire whose file states `prony` or "
               "`loss_factor` relax. \"damping\" is then a channel, and every frequency is that of "
               "the moduli at this frequency; of a tire that spins, at its frequency on the "
               "tire."},
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
damping = true
)toml",
              R"toml(kind = "modes"
speed = "100 km/h"
rim = "free"
standing_wave = true
damping = true
)toml",
          },
      .shared = {{"", pressure_keys}},
  };
  return section;
}

}  // namespace latsch::experiment
