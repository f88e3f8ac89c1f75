// SPDX-License-Identifier: Apache-2.0
#include "experiment/language/key_section.h"

namespace latsch::experiment {

const KeySection& steady_states_keys() {
  static const KeySection section = {
      .heading = "Test \"steady_states\": a table of states",
      .about = R"md(
Forces of a tire in a table of states.

A measurement is resolved into numbers when the study is read: Fz is required, quantities that
were not recorded are left out. A journal depends on these numbers, not on the measured forces.

latsch test computes a table of any length block by block. A file above 16 MB is not copied into
memory, and must not be written to while it is read.
)md",
      .sentences =
          {
              {"states",
               "Table of states in a file beside the test; `{from = \"measurement.cornering\"}` "
               "takes them as they were measured."},
              {"limits",
               "\"on\" limits inputs to the ranges of the tire's file and fades them below its "
               "VXLOW."},
              {"angles", "Angles as they are, or \"tangent\": tan(alpha), sin(gamma) instead."},
              {"turn_slip", "\"on\" computes forces and moments of turning by phit."},
              {"side",
               "Side of the vehicle on which the tire was measured, or the \"other\": the tire "
               "mirrored."},
          },
      .samples =
          {
              R"toml(kind = "steady_states"
states = "states.csv"
limits = "off"
angles = "tangent"
turn_slip = "on"
side = "other"
)toml",
          },
  };
  return section;
}

}  // namespace latsch::experiment
