// SPDX-License-Identifier: Apache-2.0
#include "experiment/language/key_section.h"

namespace latsch::experiment {

const KeySection& pressure_keys();

const KeySection& uniformity_keys() {
  static const KeySection section = {
      .heading = "Test \"uniformity\": forces that vary over a turn",
      .about = R"md(
Virtual uniformity machine: a tire rolls slowly at a constant loaded radius, forward and
backward, and the force on its spindle varies over the turn. For any tire.

Channels, N: "load"; RFV, LFV, TFV, peak to peak over a turn forward, "radial_force_variation",
"lateral_force_variation", "tangential_force_variation"; the first harmonic of each, peak to peak
as well, "radial_first_harmonic", "lateral_first_harmonic", "tangential_first_harmonic";
"conicity" and "ply_steer". A variation is the sum of the first `harmonics` harmonics, so that
segments of a belt and blocks of a tread do not count.

Forces are those on the wheel in C, whose axes stay with the wheel: x to the front, y to the
left, z up (NOTATION.md). Rolling forward the wheel turns clockwise as seen from its right side.
With F the mean of Fy rolling forward, B rolling backward,

```
conicity   (F + B)/2,  has the same side in both directions
ply steer  (F - B)/2,  changes sides with the direction
```

they are half the sum and half the difference of the lateral shifts, clockwise and
counterclockwise. Such machines are the subject of SAE J332. Above a few m/s imbalance and modes
of the tire contribute to the variations, as on machines for high speeds.

The rig is tared with the wheel in the air, for every kind of tire: the weight of a belt (GRAVITY of
a .tir, `belt.gravity` of a flexible ring) is neither in its load nor in its forces, so a load is
that of the road on the tire.
)md",
      .sentences =
          {
              {"load",
               "Mean load over a turn forward, before the axle is held; the mean of the channel Fz "
               "if it comes from a measurement."},
              {"drum_diameter",
               "Diameter of the drum; without it a flat belt.",
               "none: a flat belt"},
              {"speed", "Speed of the road, some 60 turns a minute."},
              {"wheel_inertia",
               "Moment of inertia about the spin axis, of the wheel that spins freely."},
              {"harmonics", "Number of harmonics of the turn that a variation is made of."},
              {"step",
               "Step of the simulation; from 72 km/h on a shorter one, which moves the tire by 20 "
               "mm.",
               "`\"0.001 s\"`, less from 72 km/h on"},
          },
      .samples =
          {
              R"toml(kind = "uniformity"
load = "4 kN"
pressure = "2.6 bar"
drum_diameter = "854 mm"
speed = "2 m/s"
wheel_inertia = "1.2 kg m^2"
harmonics = 8
step = "1 ms"
)toml",
          },
      .shared = {{"", pressure_keys}},
  };
  return section;
}

}  // namespace latsch::experiment
