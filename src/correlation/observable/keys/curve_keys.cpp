// SPDX-License-Identifier: Apache-2.0
#include "experiment/language/key_section.h"

namespace latsch::correlation {

const experiment::KeySection& curve_comparison_keys();
const experiment::KeySection& curve_delay_keys();
const experiment::KeySection& nuisance_keys();
const experiment::KeySection& experiment_keys();
const experiment::KeySection& noise_keys();

const experiment::KeySection& curve_keys() {
  static const experiment::KeySection section = {
      .heading = "[experiment.NAME] with kind = \"curve\"",
      .below = "experiment.*",
      .about = R"md(
Compares a curve y(x) of channels that a test records with a measured one.

The error of sample i is

```
d_i = (y_i^mea - y^sim(x_i^mea)) / scale
```

with the simulated curve linear between its samples.
)md",
      .sentences =
          {
              {"x",
               "Channel TEST/CHANNEL over which y is compared, of a simulator OUTPUT/QUANTITY. The "
               "measurement has columns that are called as the channels.",
               "none: sample by sample"},
              {"y", "Channel that is compared."},
              {"frame",
               "Axes of a measured force or moment; a column may state its own (\"FyW\"). Another "
               "frame than the test's is refused; `in_frame` of a `[measurement.NAME]` turns it.",
               "the test's"},
              {"scale",
               "Difference that counts as an error of 100 %. For \"psd\" a plain number in SI, "
               "(unit of y)^2/Hz; for \"band_levels\" in dB.",
               "the largest abs(y); of \"psd\" the highest measured density; of \"band_levels\" 10 "
               "dB"},
          },
      .samples =
          {
              R"toml([experiment.step]
kind = "curve"
x = "slow/time"
y = "slow/Fz"
measurement = "slow_measured.csv"
frame = "C"
scale = "10 N"
compare = "values"
nuisance = {delay = "free"}
[test.slow]
file = "slow.toml"
)toml",
          },
      .shared = {{"", curve_comparison_keys},
                 {"", curve_delay_keys},
                 {"", nuisance_keys},
                 {"", experiment_keys},
                 {"", noise_keys}},
  };
  return section;
}

}  // namespace latsch::correlation
