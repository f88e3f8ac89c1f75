// SPDX-License-Identifier: Apache-2.0
#include "experiment/language/key_section.h"

namespace latsch::experiment {

const KeySection& pressure_keys();

const KeySection& rolling_stiffness_keys() {
  static const KeySection section = {
      .heading = "Test \"rolling_stiffness\": slopes at free rolling",
      .about = R"md(
Characteristic slopes of a rolling tire: its response to a small slip, slip angle or camber at
free rolling. For any tire.

On the flat track, its axle following the load, the wheel rolls with the value and
with its opposite until both are steady; forces are means over a turn of the wheel:

```
slip stiffness        C_κ = (Fx(κ) - Fx(-κ))/2κ
cornering stiffness   C_α = -(Fy(α) - Fy(-α))/2α
pneumatic trail       t = -(Mz(α) - Mz(-α))/(Fy(α) - Fy(-α))
camber stiffness      C_γ = -(Fy(γ) - Fy(-γ))/2γ, above 0: toward the side it leans to
```

Forces are in W (NOTATION.md). Each difference includes the reduction of C by friction at that
slip.

The rig is tared with the wheel in the air, for every kind of tire: the weight of a belt (GRAVITY of
a .tir, `belt.gravity` of a flexible ring) is neither in its load nor in its forces, so a load is
that of the road on the tire.

A finite-element tire has these slopes from pairs of steady states ([equations](fe_tire_motion.md)),
which take seconds each, with the friction of its file, else 1; `step` has no effect on it.
)md",
      .sentences =
          {
              {"load",
               "Load of the road; the mean of the channel Fz if it comes from a measurement."},
              {"measures",
               "Stiffnesses to determine, of \"slip\", \"cornering\" and \"camber\". Channels are "
               "\"slip_stiffness\" (N), \"cornering_stiffness\" (N/rad) and \"pneumatic_trail\" "
               "(m), \"camber_stiffness\" (N/rad).",
               "all of them"},
              {"speed",
               "Speed of the belt; the mean of the channel Vx if it comes from a measurement."},
              {"slip", "Slip to both sides of free rolling."},
              {"angle", "Slip angle to both sides of free rolling."},
              {"camber", "Camber to both sides of the upright wheel."},
              {"step",
               "Step of the simulation; from 72 km/h on a shorter one, which moves the tire by 10 "
               "mm.",
               "`\"0.0005 s\"`, less from 72 km/h on"},
          },
      .samples =
          {
              R"toml(kind = "rolling_stiffness"
load = "4 kN"
pressure = "2.6 bar"
measures = ["slip", "camber"]
speed = "60 km/h"
slip = 0.002
angle = "0.25 deg"
camber = "1 deg"
step = "0.5 ms"
)toml",
          },
      .shared = {{"", pressure_keys}},
  };
  return section;
}

}  // namespace latsch::experiment
