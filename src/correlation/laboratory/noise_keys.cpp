// SPDX-License-Identifier: Apache-2.0
#include "experiment/language/key_section.h"

namespace latsch::correlation {

const experiment::KeySection& curve_keys();
const experiment::KeySection& curve_comparison_keys();
const experiment::KeySection& experiment_keys();

const experiment::KeySection& noise_keys() {
  static const experiment::KeySection section = {
      .heading = "The noise of what was measured",
      .below = "experiment.*",
      .about = R"md(
Exactness of measured values, and its use in the fit.

Noise has two more effects. The fit does not start again once the target is no larger than noise
alone makes it, so a stated noise that is too large ends the fit early. And intervals do not have
to estimate the noise.

The deviation of a temperature is a difference, stated in K: "2 degC" is a temperature, and a
share would count from absolute zero. Both are refused.

With d the error of a value as compared and sigma its stated deviation in units of
d, a value enters fit and intervals as d / sigma. With a loss of scale c and z = (x / c)^2, x
becomes  sign(x) c sqrt(rho(z)):

```
huber    rho = z  up to 1, then  2 sqrt(z) - 1    [Huber, Ann. Math. Statist. 35 (1964) 73]
cauchy   rho = ln(1 + z)
```

and a least-squares method sums the squares. With Gaussian noise, the default scales keep 95 % of
the efficiency of least squares. The intervals are those of M-estimation: a value beyond the scale
counts no more than one at the scale, and the result says how many values lie beyond it.
)md",
      .sentences =
          {
              {"noise",
               "Standard deviation of each value: in the unit of what is compared, \"20 N\"; \"2 "
               "%\" of what counts as 100 % (the measured force or frequency, the scale of a "
               "curve); or \"20 N + 2 %\", the root of both squares. \"estimated\" by the fit, in "
               "every fitted experiment or none: from stage to stage, the last of which is run "
               "twice. \"own_stage\", in every fitted experiment or none: the least error that an "
               "earlier stage left in which the experiment counts (a fit in stages).",
               "none"},
              {"loss",
               "Loss of the errors; with \"huber\" and \"cauchy\" far-off values count less."},
              {"loss_scale",
               "Error from which values count less: in units of the noise; without noise an error "
               "such as \"5 %\", which has to be given.",
               "1.345 for \"huber\", 2.385 for \"cauchy\""},
          },
      .samples =
          {
              R"toml([experiment.cleat]
kind = "curve"
x = "slow/time"
y = "slow/Fz"
measurement = "slow_measured.csv"
noise = "20 N"
loss = "huber"
loss_scale = 1.345
[test.slow]
file = "slow.toml"
)toml",
              R"toml([experiment.force]
kind = "load_deflection"
measurement = "force.csv"
loss = "cauchy"
loss_scale = "5 %"
)toml",
          },
      .shared = {{"", curve_keys}, {"", curve_comparison_keys}, {"", experiment_keys}},
  };
  return section;
}

}  // namespace latsch::correlation
