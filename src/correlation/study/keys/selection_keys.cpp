// SPDX-License-Identifier: Apache-2.0
#include "experiment/language/key_section.h"

namespace latsch::correlation {

const experiment::KeySection& selection_keys() {
  static const experiment::KeySection section = {
      .heading = "[selection]",
      .below = "selection",
      .about = R"md(
Coefficients that the measurements may not carry, for `latsch select`. It fits all candidates, drops those that the fit can do without,
refits, and keeps the model with the least criterion. See [selection.md](selection.md).
)md",
      .sentences =
          {
              {"of",
               "Names of the candidates, in which * stands for any characters: `[\"PKY*\", "
               "\"PVY3\"]`.",
               "all variables"},
              {"toward", "Table of values that candidates have if they are dropped."},
              {"toward.*",
               "Value of the candidate if it is dropped, inside its bounds.",
               "the initial value of the variable"},
              {"groups", "Table of candidates that are kept or dropped together."},
              {"groups.*",
               "Names of the candidates of the group: `camber = [\"PKY6\", \"PVY3\"]`."},
              {"criterion",
               "Number that is least for the model that is kept: \"bic\" keeps few useless "
               "coefficients, \"aicc\" more; \"cross_validation\" leaves out one recording after "
               "the other, never single samples."},
              {"refits", "Most refits of models with fewer candidates."},
              {"honest",
               "With true one half of the recordings chooses, and the other half alone determines "
               "values and intervals, which then know nothing of the choice."},
              {"seed", "Number that selects the halves."},
          },
      .samples =
          {
              R"toml([selection]
of = ["radial"]
toward = {radial = "0.5 MN/m^2"}
groups = {stiffness = ["rad*"]}
criterion = "aicc"
refits = 10
[variable.radial]
path = "sidewall.radial.stiffness"
lower = "0.2 MN/m^2"
upper = "1.5 MN/m^2"
initial = "0.55 MN/m^2"
)toml",
              R"toml([selection]
criterion = "bic"
honest = true
seed = 0
)toml",
          },
  };
  return section;
}

}  // namespace latsch::correlation
