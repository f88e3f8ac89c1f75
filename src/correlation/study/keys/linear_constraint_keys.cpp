// SPDX-License-Identifier: Apache-2.0
#include "experiment/language/key_section.h"

namespace latsch::correlation {

const experiment::KeySection& linear_constraint_keys() {
  static const experiment::KeySection section = {
      .heading = "[linear_constraint.NAME]",
      .below = "linear_constraint.*",
      .about = R"md(
Linear constraints on the variables of a study.

Every optimizer satisfies the linear constraints. A design of experiments samples the whole
bounds and ignores them.

The example is the constraint belt - 2 carcass <= 0.
)md",
      .sentences =
          {
              {"variables",
               "Variables that are added, of one physical quantity, on a linear scale."},
              {"coefficients", "Coefficient of each variable.", "1 each"},
              {"lower", "Lower bound of the sum.", "none"},
              {"upper", "Upper bound of the sum.", "none"},
              {"equal", "Value of the sum, instead of both bounds."},
          },
      .samples =
          {
              R"toml([linear_constraint.belt_softer]
variables = ["belt", "carcass"]
coefficients = [1, -2]
upper = "0 MN/m^2"
[variable.belt]
path = "sidewall.radial.stiffness"
lower = "0.2 MN/m^2"
upper = "1.5 MN/m^2"
initial = "0.55 MN/m^2"
[variable.carcass]
path = "sidewall.tangential.stiffness"
lower = "0.1 MN/m^2"
upper = "0.8 MN/m^2"
initial = "0.3 MN/m^2"
)toml",
              R"toml([linear_constraint.sum]
variables = ["radial"]
lower = "0.3 MN/m^2"
[linear_constraint.known]
variables = ["radial"]
equal = "0.55 MN/m^2"
)toml",
              R"toml([linear_constraint.size]
variables = ["size"]
lower = "295 mm"
upper = "315 mm"
[linear_constraint.exact_size]
variables = ["size"]
equal = "305 mm"
[variable.size]
path = "belt.radius"
lower = "290 mm"
upper = "320 mm"
initial = "305 mm"
)toml",
          },
  };
  return section;
}

}  // namespace latsch::correlation
