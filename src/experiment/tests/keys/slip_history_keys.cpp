// SPDX-License-Identifier: Apache-2.0
#include "experiment/language/key_section.h"

namespace latsch::experiment {

const KeySection& slip_history_keys() {
  static const KeySection section = {
      .heading = "Test \"slip_history\": slips as recorded, lagging",
      .about = R"md(
Slips as recorded, sample by sample, with the lag of the tire's relaxation
lengths.

Channels are those of steady_states, and the lagged slips "kappa" and "alpha". Relaxation lengths
are those of the tire: of formula 6 from LATERAL_STIFFNESS and LONGITUDINAL_STIFFNESS, none if
these are 0; of 5.2 from PTX1 to PTX3, PTY1 and PTY2.
)md",
      .sentences =
          {
              {"states",
               "Table in a file beside the test: time and the columns of steady_states; `{from = "
               "\"measurement.cornering\"}` takes them as they were measured."},
          },
      .samples =
          {
              R"toml(kind = "slip_history"
states = "states.csv"
)toml",
          },
  };
  return section;
}

}  // namespace latsch::experiment
