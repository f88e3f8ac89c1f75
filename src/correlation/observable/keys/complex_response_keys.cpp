// SPDX-License-Identifier: Apache-2.0
#include "experiment/language/key_section.h"

namespace latsch::correlation {

const experiment::KeySection& experiment_keys();
const experiment::KeySection& noise_keys();

const experiment::KeySection& complex_response_keys() {
  static const experiment::KeySection section = {
      .heading = "[experiment.NAME] with kind = \"frequency_response\"",
      .below = "experiment.*",
      .about = R"md(
Compares a frequency response with a measured one, real and imaginary parts together. The
measurement has the columns frequency, re_OUTPUT and im_OUTPUT, named as the channels of the test.

The errors at the measured frequency f_i are, part by part,

```
d_i = (H_i^mea - H^sim(f_i)) / |H_i^mea|
```

with the parts of the simulated response linear between its frequencies. With `averages`, the
random error |H| sqrt((1 - gamma^2)/(2 averages gamma^2)) that the measured coherence gamma^2 says
is added to the stated noise by squares, so that frequencies with little coherence count little.
)md",
      .sentences =
          {
              {"y", "Output TEST/OUTPUT, such as \"shaken/hub_Fz\"."},
              {"scale", "Difference that counts as an error of 100 %.", "the measured size"},
              {"averages",
               "Number of averages of the measured response; its coherence then is an error. "
               "`noise` has to be given, too: the error where the coherence is 1."},
              {"coherence", "Column of the coherence, 0 to 1."},
          },
      .samples =
          {
              R"toml([experiment.transfer]
kind = "frequency_response"
y = "shaken/hub_Fz"
measurement = "frf.csv"
scale = "10 N/mm"
averages = 30
coherence = "coherence"
noise = "2 %"
[test.shaken]
kind = "response"
load = "4 kN"
input = "ground"
from = "10 Hz"
to = "200 Hz"
)toml",
          },
      .shared = {{"", experiment_keys}, {"", noise_keys}},
  };
  return section;
}

}  // namespace latsch::correlation
