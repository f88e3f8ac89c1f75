// SPDX-License-Identifier: Apache-2.0
#include "experiment/language/key_section.h"

namespace latsch::experiment {

const KeySection& pressure_keys();
const KeySection& cleat_keys();

const KeySection& drum_cleat_keys() {
  static const KeySection section = {
      .heading = "Test \"drum_cleat\": over a cleat on the drum",
      .about = R"md(
Virtual drum rig: a tire on a drum with a cleat; the axle is held at one height, the wheel spins
freely.

Channels: "time" (0 when the cleat is below the axle), hub forces "Fx" .. "Mz" in that frame,
"speed" of the drum's surface and "wheel_speed" (rad/s). The origin of W is where the wheel plane
meets the smooth drum. The wheel's spin is solved by steps of the tire, with
order 2.

Without `[cleat]` the drum is smooth.

The rig is tared with the wheel in the air, for every kind of tire: the weight of a belt (GRAVITY of
a .tir, `belt.gravity` of a flexible ring) is neither in its load nor in its forces, so a load is
that of the road on the tire.

A finite-element tire begins with its steady state as a free wheel, so `run_in` has no effect on it.
The tread feels the cleat through means as wide as an element. Such a tire takes its friction from
its own file.
)md",
      .sentences =
          {
              {"speed",
               "Speed of the drum's surface; the mean of the channel Vx if it comes from a "
               "measurement."},
              {"load",
               "Load at rest, before the axle is held; the mean of the channel Fz if it comes from "
               "a measurement. The test states `load` or `deflection`."},
              {"deflection", "Deflection at rest, instead of `load`."},
              {"camber", "Inclination of the wheel about x, top to the right."},
              {"drum_diameter", "Diameter of the drum."},
              {"wheel_inertia", "Moment of inertia of the wheel about its spin axis."},
              {"run_in",
               "Time of rolling before the cleat, in which the wheel is gradually released from "
               "the speed it started with."},
              {"duration",
               "Time that is recorded, from `lead` before the cleat is below the axle."},
              {"lead", "Time from the start of the record until the cleat is below the axle."},
              {"step", "Step of the simulation; it moves the tire by 20 mm at most."},
              {"sample_step", "Step of the record, a multiple of `step`.", "`step`"},
              {"passages", "Number of passages over the cleat; the record is their average."},
              {"wheel_step", "Angle by which the wheel is turned for each further passage."},
              {"wheel_start", "Angle by which the wheel is turned for the first passage."},
              {"frame",
               "Axes of the recorded forces: W, H or C, that of the measurement; C has the axes of "
               "a hub's load cell. `[\"C\", \"W\"]` records both, \"FyC\" and \"FyW\".",
               "`\"C\"`"},
          },
      .samples =
          {
              R"toml(kind = "drum_cleat"
speed = "60 km/h"
load = "4 kN"
pressure = "2.6 bar"
camber = "2 deg"
drum_diameter = "2.5 m"
wheel_inertia = "1.2 kg m^2"
run_in = "0.2 s"
duration = "0.25 s"
lead = "0.05 s"
step = "0.5 ms"
sample_step = "1 ms"
passages = 4
wheel_step = "0.75 deg"
wheel_start = "0.3 deg"
frame = ["C", "W"]
[cleat]
height = "15 mm"
length = "30 mm"
bevel = "5 mm"
angle = "10 deg"
)toml",
              R"toml(kind = "drum_cleat"
speed = "36 km/h"
deflection = "15 mm"
pressure = "2.2 bar"
camber = "1 deg"
drum_diameter = "2 m"
wheel_inertia = "1.2 kg m^2"
run_in = "0.1 s"
duration = "0.2 s"
lead = "0.05 s"
step = "0.5 ms"
sample_step = "1 ms"
passages = 2
wheel_step = "10 deg"
wheel_start = "5 deg"
frame = ["C", "W"]
[cleat]
height = "10 mm"
length = "30 mm"
bevel = "2 mm"
angle = "10 deg"
)toml",
          },
      .shared = {{"", pressure_keys}, {"cleat", cleat_keys}},
  };
  return section;
}

}  // namespace latsch::experiment
