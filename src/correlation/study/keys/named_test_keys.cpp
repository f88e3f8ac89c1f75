// SPDX-License-Identifier: Apache-2.0
#include "experiment/language/key_section.h"

namespace latsch::experiment {
const KeySection& steady_states_keys();
const KeySection& load_deflection_keys();
}  // namespace latsch::experiment

namespace latsch::correlation {

const experiment::KeySection& named_test_keys() {
  static const experiment::KeySection section = {
      .heading = "[test.NAME]",
      .below = "test.*",
      .about = R"md(
A test of a study, for several experiments, which compare its channels by the names TEST/CHANNEL.
A trial runs the tests that fitted experiments or constraints need. The table names a file with a
kind of test, or has the content of such a file: `kind` and the keys of that test.

```toml
[test.slow]
file = "slow.toml"               # a file with a kind of test

[experiment.slow_Fz]
kind = "curve"
x = "slow/time"                  # TEST/CHANNEL
y = "slow/Fz"
measurement = "slow_measured.csv"
```

Conditions can be numbers as they were measured: `states = {from = "measurement.cornering"}`.
Their keys:
)md",
      .sentences =
          {
              {"kind", "Kind of test; the keys beside it are those of that test."},
              {"file",
               "File of the test beside the study, instead of `kind` and the keys of the test."},
              {"*.from",
               "Measurement of the study that a condition is taken from: `\"measurement.NAME\"`."},
              {"*.channel",
               "Channel of that measurement, for a key that needs one channel: \"drum_speed\".",
               "that of the name of the condition"},
              {"*.without",
               "Conditions that are left out although a column looks like them: `[\"kappa\"]`.",
               "none"},
          },
      .samples =
          {
              R"toml([measurement.cornering]
file = "cornering.csv"
[test.steady]
kind = "steady_states"
states = {from = "measurement.cornering", without = ["kappa"]}
[test.pressed]
kind = "load_deflection"
deflections = {from = "measurement.pressed", channel = "deflection"}
[measurement.pressed]
file = "force.csv"
)toml",
              R"toml([test.slow]
file = "slow.toml"
)toml",
          },
      .shared = {{"", experiment::steady_states_keys}, {"", experiment::load_deflection_keys}},
  };
  return section;
}

}  // namespace latsch::correlation
