// SPDX-License-Identifier: Apache-2.0
#include "experiment/language/key_section.h"

namespace latsch::correlation {

const experiment::KeySection& campaign_keys() {
  static const experiment::KeySection section = {
      .heading = "[design]",
      .below = "design",
      .about = R"md(
Tests that a laboratory could make next, for `latsch design`. It chooses their settings inside the limits of the rig so that the variables
become known best. See [design.md](design.md).
)md",
      .sentences =
          {
              {"test",
               "Name of the [test.NAME] whose settings move. A test through a table of measured "
               "states becomes a test of one state."},
              {"settings", "Table of the ranges of the numbers that the laboratory can set."},
              {"settings.*",
               "The two ends of the range: `load = [\"1 kN\", \"8 kN\"]`. The name is that of a "
               "number of the test, or its path, such as `states.alpha`."},
              {"limits",
               "Limits of the rig, such as `[\"load * abs(alpha) <= 40 kN deg\"]`: + - * / ^, "
               "abs, sqrt, sin, cos, tan, min, max, numbers of the test, quantities with units.",
               "none"},
              {"measures",
               "Channels of the test that are measured.",
               "those that fitted experiments compare"},
              {"noise",
               "Standard deviation of a measured value, for all channels; a share counts "
               "from the channel's largest value inside the limits.",
               "that of the fitted experiments that compare the channel"},
              {"noise.*", "Standard deviation of a value of this channel: `\"10 N + 1 %\"`."},
              {"criterion",
               "\"D\" makes the volume of the confidence region least, \"A\" the mean variance "
               "of the variables in ranges, \"I\" the mean variance of the values of the "
               "experiment `of`, \"c\" the variance of the variable `of`; \"T\" makes largest "
               "what the model of the study `against` cannot fit."},
              {"of", "Experiment beside \"I\", variable beside \"c\"."},
              {"against", "File of the study whose model is the rival, beside \"T\"."},
              {"cost",
               "Table of the costs of changing a setting; they set the order of the tests."},
              {"cost.*", "Cost of a change of this setting, in tests.", "0"},
              {"grid", "Table of the grid that a person would run, for comparison."},
              {"grid.*", "Number of levels of this setting.", "3"},
              {"count", "Number of tests, which `--count` replaces."},
              {"runs",
               "Number of settings at which the model computes its slopes, between which they are "
               "interpolated, with an error that is printed.",
               "every setting that is asked for, if the model is quick and computes slopes; else "
               "10 for each "
               "setting and 10"},
          },
      .samples =
          {
              R"toml([design]
test = "next"
settings = {load = ["1 kN", "8 kN"], alpha = ["-12 deg", "12 deg"]}
limits = ["load * abs(alpha) <= 40 kN deg"]
measures = ["Fy", "Mz"]
noise = {Fy = "10 N + 1 %", Mz = "1 N m"}
criterion = "c"
of = "radial"
cost = {load = 5}
grid = {alpha = 7}
count = 12
runs = 40
[variable.radial]
path = "sidewall.radial.stiffness"
lower = "0.2 MN/m^2"
upper = "1.5 MN/m^2"
initial = "0.55 MN/m^2"
[test.next]
kind = "rolling"
load = "4 kN"
speed = "60 km/h"
alpha = "2 deg"
)toml",
              R"toml([design]
test = "next"
settings = {load = ["1 kN", "8 kN"]}
measures = ["Fz"]
noise = "1 %"
criterion = "T"
against = "rival.toml"
[test.next]
kind = "rolling"
load = "4 kN"
speed = "60 km/h"
)toml",
          },
  };
  return section;
}

}  // namespace latsch::correlation
