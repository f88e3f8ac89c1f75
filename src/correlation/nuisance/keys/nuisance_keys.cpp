// SPDX-License-Identifier: Apache-2.0
#include "experiment/language/key_section.h"

namespace latsch::correlation {

const experiment::KeySection& curve_keys();
const experiment::KeySection& curve_comparison_keys();
const experiment::KeySection& experiment_keys();
const experiment::KeySection& noise_keys();

const experiment::KeySection& nuisance_keys() {
  static const experiment::KeySection section = {
      .heading = "nuisance of an experiment: offset, gain and shift of its recording",
      .below = "experiment.*",
      .about = R"md(
Numbers that belong to a recording and not to the model: an amplifier that drifts, a load cell
whose gain is off, clocks that start at different moments, an angle whose zero is off. With the
simulated curve y(x), the recording is

```
(1 + gain) y(x - shift) + offset
```

where the shift is `delay` over time and `x_offset` over any other abscissa. Every number is the
standard deviation of a prior with the mean 0, or "free". At every trial the numbers are solved and
not searched, so that they cost no trial. Each prior counts as one more measured value. Intervals
of the variables are those of a fit of all numbers together [variable projection: G. Golub,
V. Pereyra, SIAM Journal on Numerical Analysis 10, 1973; L. Kaufman, BIT 15, 1975].

Limits: the numbers apply to curves compared as `values` or `about_mean` and to load-deflection
curves compared by force; spectra know no delay. `about_mean` already removes an offset. A shift
stays within a tenth of the record. A free delay alone is solved as the section on the delay says.
)md",
      .sentences =
          {
              {"nuisance", "Table of what belongs to the recording and not to the model.", "none"},
              {"nuisance.offset",
               "Standard deviation of a constant that the recording adds to the compared quantity, "
               "or \"free\", or the NAME of a [nuisance.NAME] that recordings share.",
               "none"},
              {"nuisance.gain",
               "Standard deviation of the share by which the recording is too large, or \"free\", "
               "or "
               "the NAME of a [nuisance.NAME] that recordings share.",
               "none"},
              {"nuisance.delay",
               "Standard deviation of the time by which the recording is behind, or \"free\", or "
               "the "
               "NAME of a [nuisance.NAME] that recordings share.",
               "none"},
              {"nuisance.x_offset",
               "Standard deviation of the amount by which the recorded x is too large, in the unit "
               "of x, or \"free\", or the NAME of a [nuisance.NAME] that recordings share.",
               "none"},
          },
      .samples =
          {
              R"toml([experiment.passage]
kind = "curve"
x = "slow/time"
y = "slow/Fz"
measurement = "slow_measured.csv"
noise = "2 %"
nuisance = {offset = "20 N", gain = "1 %", delay = "2 ms"}
[test.slow]
file = "slow.toml"
)toml",
              R"toml([experiment.passage]
kind = "curve"
x = "slow/time"
y = "slow/Fz"
measurement = "slow_measured.csv"
nuisance = {offset = "free", gain = "free", delay = "free"}
[test.slow]
file = "slow.toml"
)toml",
              R"toml([experiment.passage]
kind = "curve"
x = "slow/speed"
y = "slow/Fz"
measurement = "over_speed.csv"
noise = "2 %"
nuisance = {x_offset = "0.5 km/h"}
[test.slow]
file = "slow.toml"
)toml",
          },
      .shared = {{"", curve_keys},
                 {"", curve_comparison_keys},
                 {"", experiment_keys},
                 {"", noise_keys}},
  };
  return section;
}

}  // namespace latsch::correlation
