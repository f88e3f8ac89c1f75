// SPDX-License-Identifier: Apache-2.0
#include "experiment/language/key_section.h"

namespace latsch::correlation {

const experiment::KeySection& noise_keys();
const experiment::KeySection& nuisance_keys();

const experiment::KeySection& experiment_keys() {
  static const experiment::KeySection section = {
      .heading = "[experiment.NAME]",
      .below = "experiment.*",
      .about = R"md(
One experiment of a study: a test, the measurement, and the method of their
comparison.

A test is stated in its experiment, or by itself as [test.NAME] for several
experiments; then test = "NAME" replaces the keys of the test.

To write measurements from the model itself (a twin), also state what the laboratory would
measure: deflections = ["5 mm", "10 mm"], or measured_modes = 12.
)md",
      .sentences =
          {
              {"kind",
               "Comparison of a force over deflection, of modes, of curves, of single values or of "
               "frequency responses. The first two can have their test's keys in the experiment "
               "itself. An outside program has the others."},
              {"test",
               "Test of the study whose channels are compared, `[test.NAME]`, for "
               "\"load_deflection\" and \"modes\".",
               "the test that the experiment states",
               "the name of a `[test.NAME]`"},
              {"measurement",
               "File beside the study, or the name of a `[measurement.NAME]`. For "
               "\"load_deflection\" it has columns deflection (or loaded_radius) and force, for "
               "\"modes\" a file with a column frequency and n, type, phase if known."},
              {"pressure",
               "Inflation pressure of the tire in the experiment's own test.",
               "the tire's own"},
              {"friction", "Friction with the ground in the experiment's own test."},
              {"deflection",
               "Deflection of the tire in the experiment's own test of modes, or `load`; neither: "
               "unloaded."},
              {"load",
               "Load of the tire in the experiment's own test of modes, instead of `deflection`."},
              {"compare", "Compared quantity of \"load_deflection\": the force or its root."},
              {"exponent", "Exponent of the relative errors in the target, at most 10."},
              {"weight", "Weight of the experiment in the target; 0 leaves it out."},
              {"use", "\"predict\": compared in the report, not fitted."},
              {"deflections",
               "Deflections at which a twin of a laboratory measures, for \"load_deflection\" "
               "without a measurement."},
              {"shapes",
               "File of measured mode shapes; modes are then paired by MAC.",
               "none: modes are paired by their names"},
              {"min_mac", "Least MAC of a pair."},
              {"missing_mode",
               "Relative error of the frequency of a measured mode without a partner."},
              {"simulated_modes",
               "Number of the lowest modes computed.",
               "8 more than measured",
               "from the number measured to 200"},
              {"measured_modes",
               "Number of modes that a twin of a laboratory measures, for \"modes\" without a "
               "measurement.",
               "the number in the measurement"},
          },
      .samples =
          {
              R"toml([experiment.stiffness]
kind = "load_deflection"
pressure = "2.6 bar"
measurement = "force.csv"
compare = "force"
exponent = 1
weight = 1
noise = "1 %"
use = "fit"
[experiment.modes]
kind = "modes"
pressure = "2.6 bar"
deflection = "25 mm"
measurement = "modes.csv"
shapes = "mode_shapes.csv"
min_mac = 0.5
missing_mode = 1
simulated_modes = 28
noise = "1 %"
)toml",
              R"toml([experiment.loaded]
kind = "modes"
friction = 0.8
load = "4 kN"
measurement = "modes.csv"
measured_modes = 2
[experiment.force]
kind = "load_deflection"
friction = 0.8
measurement = "force.csv"
deflections = ["5 mm", "10 mm"]
[experiment.named]
kind = "load_deflection"
test = "pressed"
measurement = "force.csv"
[test.pressed]
kind = "load_deflection"
deflections = ["5 mm", "10 mm"]
)toml",
          },
      .shared = {{"", noise_keys}, {"", nuisance_keys}},
  };
  return section;
}

}  // namespace latsch::correlation
