// SPDX-License-Identifier: Apache-2.0
#include "experiment/language/key_section.h"

namespace latsch::experiment {

const KeySection& pressure_keys() {
  static const KeySection section = {
      .heading = "pressure of a test",
      .about = R"md(
The inflation pressure of the tire in a test.

```toml
pressure = "2.6 bar"             # or {from = "measurement.cornering"}: the mean of its channel
                                 # pressure; the tire's own unless given
```
)md",
      .sentences =
          {
              {"pressure",
               "Inflation pressure of the tire; `{from = \"measurement.cornering\"}` takes the "
               "mean of its channel pressure.",
               "the tire's own"},
          },
      .samples = {},
  };
  return section;
}

}  // namespace latsch::experiment
