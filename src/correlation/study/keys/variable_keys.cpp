// SPDX-License-Identifier: Apache-2.0
#include "experiment/language/key_section.h"

namespace latsch::correlation {

const experiment::KeySection& variable_keys() {
  static const experiment::KeySection section = {
      .heading = "[variable.NAME]",
      .below = "variable.*",
      .about = R"md(
Binds a design variable of a study to numbers of its model. Any number in the model file can be
varied; the model itself does not know which ones are. In the study of an outside program a
variable has no path.

A prior counts as one more measured value, in the fit and in the intervals; it needs the noise of
the experiments, against which it is weighted.
)md",
      .sentences =
          {
              {"path",
               "Path of the number in the model's file; in a .tir the name of the parameter: "
               "\"PKY1\"."},
              {"paths", "Paths of several numbers that have one value, instead of `path`."},
              {"lower", "Lower bound."},
              {"upper", "Upper bound."},
              {"initial", "Value at which a search starts."},
              {"scale", "Scale on which the variable is searched."},
              {"prior", "Value that is known before.", "none"},
              {"prior_sigma",
               "Standard deviation of the prior: a quantity, or a share of the value. For a linear "
               "variable without a unit it is no share but a plain number, which may be above 1.",
               "none"},
              {"unit", "Unit of a variable of an outside program.", "that of `initial`"},
          },
      .samples =
          {
              R"toml([variable.matrix]
path = "sidewall.radial.stiffness"
lower = "0.2 MN/m^2"
upper = "1.5 MN/m^2"
initial = "0.55 MN/m^2"
scale = "logarithmic"
prior = "0.5 MN/m^2"
prior_sigma = "20 %"
[variable.size]
paths = ["belt.radius"]
lower = "290 mm"
upper = "320 mm"
initial = "305 mm"
prior = "305 mm"
prior_sigma = "5 mm"
[experiment.force]
kind = "load_deflection"
measurement = "force.csv"
noise = "1 %"
)toml",
              R"toml([simulator]
command = ["true"]
inputs = ["spring.txt"]
[simulator.output.response]
file = "response.csv"
reader = "table"
quantities = ["time [s]", "z [mm]"]
[variable.modulus]
unit = "N/mm^2"
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
  };
  return section;
}

}  // namespace latsch::correlation
