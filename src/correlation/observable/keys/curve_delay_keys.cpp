// SPDX-License-Identifier: Apache-2.0
#include "experiment/language/key_section.h"

namespace latsch::correlation {

const experiment::KeySection& curve_keys();
const experiment::KeySection& curve_comparison_keys();
const experiment::KeySection& experiment_keys();
const experiment::KeySection& noise_keys();

const experiment::KeySection& curve_delay_keys() {
  static const experiment::KeySection section = {
      .heading = "nuisance of a curve: the delay of its recording",
      .below = "experiment.*",
      .about = R"md(
Delay of a measured curve behind the simulated one. It belongs to the recording, not to the
model: the clocks of rigs and tests start at different moments.

Sample i, recorded at t_i, is compared with the simulated y(t_i - tau). At every trial, tau
minimizes the sum of the squared differences d_i(tau):

```
- tau lies within a tenth of the record before or behind, as far as the simulation covers the
  measured samples;
- the best of a grid no wider than a simulated step is refined by Gauss-Newton steps
  tau - a'd / a'a  with  a_i = d d_i / d tau,  which end exactly because y is linear between
  its samples.
```

The delay is solved for, not searched, so it costs no trial. Slopes of the differences by the
variables of the model lose their part along a [variable projection: G. Golub, V. Pereyra, SIAM
Journal on Numerical Analysis 10, 1973; L. Kaufman, BIT 15, 1975],

```
d' = J - a (a'J) / a'a,   and the delay moves by  -(a'J) / a'a.
```

Limits: only `values` and `about_mean` have a delay; a spectrum does not depend on it. A signal
that repeats itself within a fifth of the record has several delays that are nearly as good.
)md",
      .sentences =
          {
              {"nuisance.delay",
               "\"free\": the delay of the recording behind the simulation is fitted at every "
               "trial.",
               "none"},
          },
      .samples =
          {
              R"toml([experiment.passage]
kind = "curve"
x = "slow/time"
y = "slow/Fz"
measurement = "slow_measured.csv"
nuisance = {delay = "free"}
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
