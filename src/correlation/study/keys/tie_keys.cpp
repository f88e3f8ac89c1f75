// SPDX-License-Identifier: Apache-2.0
#include "experiment/language/key_section.h"

namespace latsch::correlation {

const experiment::KeySection& tie_keys() {
  static const experiment::KeySection section = {
      .heading = "[tie.NAME]",
      .below = "tie.*",
      .about = R"md(
A number of the model that moves with a variable or another tie.
)md",
      .sentences =
          {
              {"path", "Path of the number in the model's file."},
              {"paths", "Paths of several numbers, instead of `path`."},
              {"follows", "Name of the variable or of the tie that the number follows."},
              {"factor", "Factor between its value and that of what it follows."},
          },
      .samples =
          {
              R"toml([tie.rim_side]
path = "sidewall.tangential.stiffness"
follows = "radial"
factor = 1.5
[tie.other_side]
paths = ["sidewall.lateral.stiffness"]
follows = "rim_side"
)toml",
          },
  };
  return section;
}

}  // namespace latsch::correlation
