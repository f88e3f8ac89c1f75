// SPDX-License-Identifier: Apache-2.0
#include "experiment/language/key_section.h"

namespace latsch::experiment {

const KeySection& frequency_keys() {
  static const KeySection section = {
      .heading = "frequencies of a response",
      .about = R"md(
The frequencies of the tests "response" and "rolling_response": a list, or a range with a step.
)md",
      .sentences =
          {
              {"frequencies",
               "Frequencies, ascending. `{from = \"measurement.frf\"}` takes its column "
               "frequency."},
              {"from", "Lowest frequency, instead of `frequencies`."},
              {"to", "Highest frequency."},
              {"step", "Distance of frequencies."},
          },
      .samples = {},
  };
  return section;
}

}  // namespace latsch::experiment
