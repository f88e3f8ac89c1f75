// SPDX-License-Identifier: Apache-2.0
#include "experiment/language/key_section.h"

namespace latsch::correlation {

const experiment::KeySection& curve_keys();
const experiment::KeySection& experiment_keys();
const experiment::KeySection& noise_keys();

const experiment::KeySection& curve_comparison_keys() {
  static const experiment::KeySection section = {
      .heading = "What of a curve is compared",
      .below = "experiment.*",
      .about = R"md(
Properties of two curves y(x) that are compared. Each value is a residual of its own:

```
values       y at every measured x: the time series, or force over slip
about_mean   y minus its mean: a constant offset does not count
psd          power spectral density of y over time: neither an offset nor a phase counts
             [thesis K, 3.3: the cost is the RMS between the densities, exponent = 2]
band_levels  level of y in third-octave bands in dB: weak bands count like strong ones
path         distance of every measured point (x, y) from the simulated line in the plane of
             x / x_scale and y / scale: on a steep curve a small shift of x is a small error,
             and the curve may turn back (up and down a slip sweep)
```
)md",
      .sentences =
          {
              {"compare", "Property that is compared."},
              {"band",
               "Band of frequencies of \"psd\" and \"band_levels\", within half the rate of the "
               "samples.",
               "from the lowest line to half the rate"},
              {"convention", "Program whose defaults the spectrum has."},
              {"segment",
               "Length of a segment of the spectrum, a part of the record.",
               "as the convention has it"},
              {"rate", "Rate of the samples where there is no x."},
              {"x_scale",
               "Difference of x that counts as 100 % in the plane of a \"path\", in the unit of x: "
               "\"2 deg\" over a slip angle, \"10 ms\" over time; \"10 %\" only where x has no "
               "unit, as a slip.",
               "the largest abs(x)"},
          },
      .samples =
          {
              R"toml([experiment.cleat]
kind = "curve"
x = "slow/time"
y = "slow/Fz"
measurement = "slow_measured.csv"
compare = "psd"
band = ["50 Hz", "300 Hz"]
convention = "scipy"
segment = "20 ms"
scale = 1e4
[test.slow]
file = "slow.toml"
)toml",
              R"toml([experiment.path]
kind = "curve"
x = "slow/time"
y = "slow/Fz"
measurement = "slow_measured.csv"
compare = "path"
x_scale = "10 ms"
[test.slow]
file = "slow.toml"
)toml",
              R"toml([experiment.path]
kind = "curve"
x = "pressed/deflection"
y = "pressed/force"
measurement = "force.csv"
compare = "path"
x_scale = "1 mm"
[test.pressed]
kind = "load_deflection"
deflections = ["5 mm", "10 mm"]
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
y = "response/z"
measurement = "step.csv"
compare = "psd"
rate = "2 kHz"
)toml",
          },
      .shared = {{"", curve_keys}, {"", experiment_keys}, {"", noise_keys}},
  };
  return section;
}

}  // namespace latsch::correlation
