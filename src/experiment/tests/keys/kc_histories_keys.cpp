// SPDX-License-Identifier: Apache-2.0
#include "experiment/language/key_section.h"

namespace latsch::experiment {

const KeySection& kc_histories_keys() {
  static const KeySection section = {
      .heading = "What a K&C rig states or has recorded, slopes over it",
      .about = R"md(
Conditions of the tests of K&C rigs: histories of loads, travel and rack, one value for each
state, in the file or as they were recorded, and the slopes over one of them.

```toml
Fz = ["0 N", "2.5 kN", "5 kN"]       # of every state, or one for all of them
Fz = {from = "measurement.rig"}      # its channel Fz; or channel = "left_pad"
loads = {from = "measurement.rig"}   # all loads that it recorded, by their names
slopes_by = "Fz"                     # adds dz_by_Fz, toe_by_Fz ...
window = ["1 kN", "4 kN"]            # over the states whose Fz is in this range
```
)md",
      .sentences =
          {
              {"Fx, Fy, Fz, Mx, My, Mz",
               "Load of the ground on the tire, of every state or one for all of them; `{from = "
               "\"measurement.rig\"}` takes the channel of that name as it was recorded, `channel "
               "= \"left_pad\"` beside it another one."},
              {"loads",
               "All loads that the rig recorded, by their names: `{from = \"measurement.rig\"}`."},
              {"slopes_by",
               "Stated quantity by which slopes are computed: \"Fz\" adds dz_by_Fz, toe_by_Fz ..., "
               "the slopes of a regression.",
               "no slopes"},
              {"window",
               "Range of the quantity in `slopes_by` over whose states the slopes are computed.",
               "all states"},
          },
      .samples = {},
  };
  return section;
}

}  // namespace latsch::experiment
