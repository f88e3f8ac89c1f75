// SPDX-License-Identifier: Apache-2.0
#include "experiment/language/key_section.h"

namespace latsch::correlation {

const experiment::KeySection& named_test_keys();
const experiment::KeySection& simulator_keys();

const experiment::KeySection& refined_keys() {
  static const experiment::KeySection section = {
      .heading = "[refined]: what mesh and step make of the numbers",
      .below = "refined",
      .about = R"md(
The model of a study on a finer mesh or with smaller steps. A fit absorbs the discretization
error into its values; the refined model shows by how much.

Intervals then extend to the values that the refined model would need for the same fit. Refine so
far that a still finer model changes little in comparison, because errors beyond the refined
model are not counted. Its trial has no time limit.
)md",
      .sentences =
          {
              {"model.*", "Numbers of the model, as in a stage: `model.belt.nodes = 200`."},
              {"test",
               "Tables `[refined.test.NAME]`: each in place of the test of that name, written as "
               "`[test.NAME]`."},
              {"simulator",
               "Outside program in place of that of the study, written as `[simulator]`."},
          },
      .samples =
          {
              R"toml([refined]
model.belt.nodes = 200
model.tread.blocks = 20
[refined.test.slow]
file = "slow.toml"
[test.slow]
file = "slow.toml"
)toml",
              R"toml([simulator]
command = ["true"]
inputs = ["spring.txt"]
[simulator.output.response]
file = "response.csv"
reader = "table"
quantities = ["time [s]", "z [mm]"]
[refined.simulator]
command = ["python3", "{study}/beam.py", "beam.txt", "--elements", "80"]
inputs = ["spring.txt"]
[refined.simulator.output.response]
file = "response.csv"
reader = "table"
quantities = ["time [s]", "z [mm]"]
[variable.modulus]
lower = "100 GPa"
upper = "300 GPa"
initial = "150 GPa"
[experiment.step]
kind = "curve"
x = "response/time"
y = "response/z"
measurement = "step.csv"
)toml",
          },
      .shared = {{"test.*", named_test_keys}, {"simulator", simulator_keys}},
  };
  return section;
}

}  // namespace latsch::correlation
