// SPDX-License-Identifier: Apache-2.0
#include "experiment/language/key_section.h"

namespace latsch::correlation {

const experiment::KeySection& study_keys() {
  static const experiment::KeySection section = {
      .heading = "A study",
      .is_top = true,
      .about = R"md(
A study contains everything that reproduces a correlation: a model, its variables, the
experiments with their measurements, and the optimizer.
)md",
      .sentences =
          {
              {"title", "Title of reports and pages.", "the name of the file"},
              {"model",
               "File of the model beside the study, or the table `[model]`; a tire that rolls, a "
               "suspension, a car ... An outside program has `[simulator]` instead."},
              {"simulator", "Outside program in the model's place."},
              {"vary",
               "Numbers of the model by their paths: each a variable of its own name, from its "
               "value in the model's file, between bounds the kind of model has for it.",
               "none"},
              {"test", "Tables `[test.NAME]`: tests for several experiments."},
              {"variable", "Tables `[variable.NAME]`: what is varied."},
              {"tie", "Tables `[tie.NAME]`: numbers that move with a variable."},
              {"linear_constraint",
               "Tables `[linear_constraint.NAME]`: constraints on the variables."},
              {"measurement", "Tables `[measurement.NAME]`: recordings of a laboratory."},
              {"nuisance",
               "Tables `[nuisance.NAME]`: numbers of the rig that several recordings share."},
              {"experiment", "Tables `[experiment.NAME]`: what is compared."},
              {"constraint", "Tables `[constraint.NAME]`: constraints on recorded values."},
              {"optimizer", "Way of the search.", "the method \"auto\""},
              {"stage", "Tables `[stage.NAME]`: one fit after the other."},
              {"refined", "Finer model that is evaluated once, at the values found."},
              {"doe", "Design of experiments."},
              {"posterior", "Samples of the posterior density, for `latsch sample`."},
              {"selection", "Coefficients that may be dropped, for `latsch select`."},
              {"design", "Tests that could be made next, for `latsch design`."},
              {"run", "Settings for running the trials."},
          },
      .samples =
          {
              R"toml(title = "Tire B, three moduli"
model = "model.toml"
vary = ["sidewall.progressivity"]
[variable.radial]
path = "sidewall.radial.stiffness"
lower = "0.2 MN/m^2"
upper = "1.5 MN/m^2"
initial = "0.55 MN/m^2"
[tie.tangential]
path = "sidewall.tangential.stiffness"
follows = "radial"
[linear_constraint.soft]
variables = ["radial"]
upper = "1 MN/m^2"
[measurement.pressed]
file = "force.csv"
[test.press]
kind = "load_deflection"
deflections = {from = "measurement.pressed"}
[nuisance.cell]
gain = "free"
[experiment.stiffness]
kind = "load_deflection"
test = "press"
measurement = "pressed"
nuisance = {gain = "cell"}
[constraint.stiff_enough]
channel = "press/force"
lower = "1 kN"
[optimizer]
max_steps = 100
[stage.coarse]
max_steps = 60
[refined]
model.tread.blocks = 20
[doe]
levels = 5
[posterior]
samples = 1000
[selection]
of = ["radial"]
[design]
test = "roll"
settings = {load = ["1 kN", "8 kN"]}
measures = ["Fz"]
[test.roll]
kind = "rolling"
load = "4 kN"
speed = "60 km/h"
[run]
workers = 2
)toml",
              R"toml([simulator]
command = ["true"]
inputs = ["spring.txt"]
[simulator.output.response]
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
      .refused = {"kind", "tire", "target"},
  };
  return section;
}

}  // namespace latsch::correlation
