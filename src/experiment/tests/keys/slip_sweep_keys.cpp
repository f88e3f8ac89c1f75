// SPDX-License-Identifier: Apache-2.0
#include "experiment/language/key_section.h"

namespace latsch::experiment {

const KeySection& pressure_keys();

const KeySection& slip_sweep_keys() {
  static const KeySection section = {
      .heading = "Test \"slip_sweep\": on a flat track",
      .about = R"md(
The belt of a flat track below a wheel that is
steered or braked.

The rig is tared with the wheel in the air, for every kind of tire: the weight of a belt (GRAVITY of
a .tir, `belt.gravity` of a flexible ring) is neither in its load nor in its forces, so a load is
that of the road on the tire.
)md",
      .sentences =
          {
              {"speed",
               "Speed of the belt; the mean of the channel Vx if it comes from a measurement."},
              {"load",
               "Load of the road; the mean of the channel Fz if it comes from a measurement."},
              {"camber", "Inclination of the wheel."},
              {"axle",
               "Quantity that the rig holds constant: the load, or the height of the axle."},
              {"frame",
               "Axes of the recorded forces: \"W\", \"H\", \"C\" or several; `[\"C\", \"W\"]` "
               "records \"FyC\" and \"FyW\".",
               "`\"W\"`"},
              {"alpha",
               "Slip angles from and to which the wheel is steered; the test states `alpha` or "
               "`kappa`."},
              {"kappa",
               "Slips from and to which the wheel is braked or driven, counted from the wheel that "
               "rolls freely: horizontal shifts of a Magic Formula (PHX1, PHX2) have no effect, "
               "while steady_states counts from the effective rolling radius."},
              {"run_in",
               "Time of free rolling before the sweep, at least: the wheel rolls on until its "
               "force is "
               "steady."},
              {"duration",
               "Duration of the sweep. Forces follow the slip over the relaxation length of the "
               "tire: "
               "`latsch test` says if they lag by more than a twentieth of the greatest force, and "
               "which duration would be enough."},
              {"step", "Step of the simulation; it moves the tire by 20 mm at most."},
              {"sample_step", "Step of the record, a multiple of `step`.", "`step`"},
          },
      .samples =
          {
              R"toml(kind = "slip_sweep"
speed = "60 km/h"
load = "4 kN"
pressure = "2.6 bar"
camber = "2 deg"
axle = "load"
frame = ["W"]
alpha = ["-10 deg", "10 deg"]
run_in = "0.3 s"
duration = "1 s"
step = "0.5 ms"
sample_step = "5 ms"
)toml",
              R"toml(kind = "slip_sweep"
speed = "20 m/s"
load = "4 kN"
pressure = "2.2 bar"
camber = "1 deg"
axle = "load"
frame = ["W"]
kappa = [-0.1, 0.1]
run_in = "0.2 s"
duration = "0.4 s"
step = "0.5 ms"
sample_step = "1 ms"
)toml",
          },
      .shared = {{"", pressure_keys}},
  };
  return section;
}

}  // namespace latsch::experiment
