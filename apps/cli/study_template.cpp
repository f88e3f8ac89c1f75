// SPDX-License-Identifier: Apache-2.0
#include "cli/study_template.h"

namespace latsch::cli {
namespace {

constexpr std::string_view kHead =
    R"(# A study: which numbers of tire.toml may vary, what was measured, how the two are compared.
# Quantities carry their units: "2.4 bar", "35 psi", "5 N/mm^2", "22 deg". `latsch check study.toml` reads all of it.
title = "My tire"
model = "tire.toml"

# Any number in tire.toml can vary; `path` says which, `paths = [...]` gives one value to several.
# Logarithmic: a factor is as likely up as down.
)";

constexpr std::string_view kRaceVariables = R"([variable.carcass]
paths = ["layer.carcass_1.young_modulus", "layer.carcass_2.young_modulus"]
lower = "1 GPa"
upper = "20 GPa"
initial = "5 GPa"
scale = "logarithmic"

[variable.sidewall]
path = "rubber.sidewall.young_modulus"
lower = "10 N/mm^2"
upper = "150 N/mm^2"
initial = "40 N/mm^2"
scale = "logarithmic"
)";

constexpr std::string_view kMatrixVariable = R"([variable.matrix]
path = "rubber.matrix.young_modulus"
lower = "2 N/mm^2"
upper = "50 N/mm^2"
initial = "10 N/mm^2"
scale = "logarithmic"
)";

constexpr std::string_view kPassengerVariables = R"([variable.sidewall]
paths = ["rubber.upper_sidewall.young_modulus", "rubber.lower_sidewall.young_modulus"]
lower = "1 N/mm^2"
upper = "20 N/mm^2"
initial = "5 N/mm^2"
scale = "logarithmic"
)";

// Of layers 1 mm thick, as tire B's.
constexpr std::string_view kLayerVariables = R"(
[variable.carcass]
path = "layer.carcass.young_modulus"
lower = "60 N/mm^2"
upper = "2000 N/mm^2"
initial = "400 N/mm^2"
scale = "logarithmic"

[variable.belt]
paths = ["layer.belt_1.young_modulus", "layer.belt_2.young_modulus"]
lower = "1000 N/mm^2"
upper = "20000 N/mm^2"
initial = "5000 N/mm^2"
scale = "logarithmic"
)";

constexpr std::string_view kCordVariables = R"(
[variable.carcass]
path = "layer.carcass.young_modulus"
lower = "1 GPa"
upper = "20 GPa"
initial = "6 GPa"
scale = "logarithmic"

[variable.belt]
paths = ["layer.belt_1.young_modulus", "layer.belt_2.young_modulus"]
lower = "20 GPa"
upper = "200 GPa"
initial = "110 GPa"
scale = "logarithmic"
)";

constexpr std::string_view kTail = R"(
# Forces at the measured deflections, counted from the first touch of the ground.
[experiment.stiffness]
kind = "load_deflection"
pressure = "2.4 bar"
measurement = "stiffness.csv"       # columns deflection (or loaded_radius) and force
compare = "force"                   # or "root_force", which goes with stiffness as a frequency does
exponent = 1                        # k of mean |dF|^k
weight = 1
use = "fit"                         # or "predict": compared in the report only
# noise = "1 %"                     # of a measured value, where known; then of every fitted experiment
deflections = {unit = "mm", values = [5, 10, 15, 20, 25, 30]}  # for `latsch export --measurements` alone

# Modes of the tire on its clamped rim. Unloaded; add deflection = "20 mm" or load = "4 kN" to stand it on the ground.
[experiment.modes]
kind = "modes"
pressure = "2.4 bar"
measurement = "modes.csv"           # column frequency; n, type, phase where known
# shapes = "mode_shapes.csv"        # where measured: modes are then paired by MAC
exponent = 1
weight = 1
measured_modes = 10                 # for `latsch export --measurements` alone

[optimizer]
method = "auto"                     # or "residual_trust_region", "gss", "sqp", "nelder_mead", ...
initial_step = 0.2                  # lengths are shares of a variable's range
step_tolerance = 0.005

[doe]                               # for `latsch doe`
design = "full_factorial"           # or "latin_hypercube", "sobol", "morris", with points = 40
levels = 5                          # values of each variable

[run]
workers = 2                         # the result does not depend on it
timeout = "10 min"                  # a trial
)";

}  // namespace

std::string study_template(std::string_view tire) {
  std::string text(kHead);
  if (tire.starts_with("race")) return text.append(kRaceVariables).append(kTail);
  const bool tire_b = tire.find("225_50R16") != tire.npos;
  const bool one_rubber = tire_b || tire.find("235_45R20") != tire.npos;
  return text.append(one_rubber ? kMatrixVariable : kPassengerVariables)
      .append(tire_b ? kLayerVariables : kCordVariables)
      .append(kTail);
}

std::string_view stiffness_template() {
  return "# Example, published for a 205/55R16 at 2.4 bar. Replace by your measurement.\n"
         "deflection [mm], force [N]\n18.2, 3015.5\n32.4, 6031.1\n";
}

std::string_view modes_template() {
  return "# Example, published for a 205/55R16 at 2.4 bar, rim clamped. Replace by your "
         "measurement.\n"
         "# n: waves around; type: torsional, lateral, radial; leave unknown cells empty.\n"
         "frequency [Hz], n, type\n50.3, 1, lateral\n54.1, 0, torsional\n69.7, 1, radial\n";
}

}  // namespace latsch::cli
