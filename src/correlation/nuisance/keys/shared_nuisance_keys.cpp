// SPDX-License-Identifier: Apache-2.0
#include "experiment/language/key_section.h"

namespace latsch::correlation {

const experiment::KeySection& shared_nuisance_keys() {
  static const experiment::KeySection section = {
      .heading = "[nuisance.NAME]: numbers that several recordings share",
      .below = "nuisance.*",
      .about = R"md(
A number that belongs to the rig and not to one recording: the gain of a load cell that measured
all of them, the zero of an angle that was set once, the lag of a recorder. Each experiment that
shares it names the table in place of a deviation:

```
[nuisance.cell]
gain = "1 %"

[experiment.light]
nuisance = {gain = "cell", offset = "20 N"}

[experiment.heavy]
nuisance = {gain = "cell", offset = "20 N"}
```

Every trial solves one gain for both recordings, beside the offset that each has of its own. Its
prior counts as one measured value, not as one for each recording.

Limits: the experiments that share an offset or an x_offset compare quantities of one kind. Where a
recording is left out, as in a cross-validation, the shared number stays as all recordings together
choose it, to first order.
)md",
      .sentences =
          {
              {"offset",
               "Standard deviation of a constant that all its recordings add to the compared "
               "quantity, or \"free\".",
               "none"},
              {"gain",
               "Standard deviation of the share by which all its recordings are too large, or "
               "\"free\".",
               "none"},
              {"delay",
               "Standard deviation of the time by which all its recordings are behind, or "
               "\"free\".",
               "none"},
              {"x_offset",
               "Standard deviation of the amount by which the x of all its recordings is too "
               "large, in the unit of x, or \"free\".",
               "none"},
          },
      .samples =
          {
              R"toml([nuisance.cell]
offset = "10 N"
gain = "1 %"
delay = "2 ms"
[experiment.passage]
kind = "curve"
x = "slow/time"
y = "slow/Fz"
measurement = "slow_measured.csv"
noise = "2 %"
nuisance = {offset = "cell", gain = "cell", delay = "cell"}
[test.slow]
file = "slow.toml"
)toml",
              R"toml([nuisance.recorder]
offset = "free"
gain = "free"
delay = "free"
[experiment.passage]
kind = "curve"
x = "slow/time"
y = "slow/Fz"
measurement = "slow_measured.csv"
nuisance = {offset = "recorder", gain = "recorder", delay = "recorder"}
[test.slow]
file = "slow.toml"
)toml",
              R"toml([nuisance.encoder]
x_offset = "0.5 km/h"
[experiment.passage]
kind = "curve"
x = "slow/speed"
y = "slow/Fz"
measurement = "over_speed.csv"
noise = "2 %"
nuisance = {x_offset = "encoder"}
[test.slow]
file = "slow.toml"
)toml",
          },
  };
  return section;
}

}  // namespace latsch::correlation
