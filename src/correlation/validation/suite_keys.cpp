// SPDX-License-Identifier: Apache-2.0
#include "experiment/language/key_section.h"

namespace latsch::correlation {

const experiment::KeySection& experiment_keys();
const experiment::KeySection& named_test_keys();
const experiment::KeySection& measurement_keys();

const experiment::KeySection& suite_keys() {
  static const experiment::KeySection section = {
      .heading = "A suite: acceptance of a model",
      .about = R"md(
Acceptance of a model: a suite of checks, each with a comparison, its limit, and the source of
the limit. `latsch validate MODEL SUITE.toml` runs the checks.

Limits are inclusive. A measured mode without a partner has the error missing_mode. Keys that
weight a fit (weight, use, exponent, noise, loss) are not allowed here, because nothing is
fitted.
)md",
      .sentences =
          {
              {"title", "Title of the report.", "the name of the file"},
              {"test", "Tables `[test.NAME]`, as in a study."},
              {"measurement", "Tables `[measurement.NAME]`, as in a study."},
              {"check",
               "Tables `[check.NAME]`: an experiment as in a study with limits of its errors, or "
               "one number of a channel, as a constraint of a study."},
              {"check.*.source", "Source of the limit: \"test report 4711, March 2025\"."},
              {"check.*.mean_error",
               "Limit of the mean over all values; this or `largest_error` or both."},
              {"check.*.largest_error", "Limit for every value."},
              {"check.*.channel", "Channel whose number is checked."},
              {"check.*.of", "Value of the channel that is checked."},
              {"check.*.lower", "Lower limit.", "none"},
              {"check.*.upper", "Upper limit.", "none"},
          },
      .samples =
          {
              R"toml(title = "Passenger tire 205/55 R16 at 2.4 bar"
[test.standing]
kind = "load_deflection"
deflections = ["20 mm"]
[measurement.pressed]
file = "force.csv"
[check.stiffness]
kind = "load_deflection"
measurement = "pressed"
mean_error = "5 %"
largest_error = "10 %"
source = "test report 4711, March 2025"
[check.vertical]
channel = "standing/force"
of = "largest"
lower = "4 kN"
upper = "4.5 kN"
source = "drawing 12-345, sheet 2"
[check.radius]
channel = "standing/loaded_radius"
lower = "280 mm"
upper = "300 mm"
source = "drawing 12-345, sheet 2"
)toml",
          },
      .shared = {{"check.*", experiment_keys},
                 {"test.*", named_test_keys},
                 {"measurement.*", measurement_keys}},
      .refused = {"check.*.equal",
                  "check.*.weight",
                  "check.*.use",
                  "check.*.exponent",
                  "check.*.noise",
                  "check.*.loss"},
  };
  return section;
}

}  // namespace latsch::correlation
