// SPDX-License-Identifier: Apache-2.0
#include "experiment/language/key_section.h"

namespace latsch::correlation {

const experiment::KeySection& constraint_keys() {
  static const experiment::KeySection section = {
      .heading = "[constraint.NAME]: on channels",
      .below = "constraint.*",
      .about = R"md(
Constraint on a value that a trial records. It is nonlinear in the variables.

With y that value:  c = (lower - y) / scale,  (y - upper) / scale,  h = (y - equal) / scale. The
constraint counts as fulfilled up to 0.0001 of the scale. The
methods gss_nlc and sqp support such constraints. If the channel is not recorded, the error
message lists the recorded ones.
)md",
      .sentences =
          {
              {"channel",
               "Channel TEST/CHANNEL, or EXPERIMENT/CHANNEL of an experiment's own test; of a "
               "simulator OUTPUT/QUANTITY."},
              {"of",
               "Value of the channel that the constraint is on; to be stated for a lower bound on "
               "several values."},
              {"lower", "Lower bound.", "none"},
              {"upper", "Upper bound.", "none"},
              {"equal", "Value, instead of both bounds."},
              {"scale", "Difference that counts as a violation of 100 %.", "the size of the bound"},
          },
      .samples =
          {
              R"toml([constraint.stiff_enough]
channel = "pressed/force"
of = "largest"
lower = "4 kN"
upper = "8 kN"
scale = "1 kN"
[constraint.exact]
channel = "pressed/force"
equal = "5 kN"
[constraint.radius]
channel = "pressed/loaded_radius"
lower = "290 mm"
upper = "310 mm"
scale = "1 mm"
[constraint.exact_radius]
channel = "pressed/loaded_radius"
equal = "300 mm"
[test.pressed]
kind = "load_deflection"
deflections = ["5 mm", "10 mm"]
)toml",
          },
  };
  return section;
}

}  // namespace latsch::correlation
