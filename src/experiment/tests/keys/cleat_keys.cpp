// SPDX-License-Identifier: Apache-2.0
#include "experiment/language/key_section.h"

namespace latsch::experiment {

const KeySection& cleat_keys() {
  static const KeySection section = {
      .heading = "[cleat] of a test",
      .about = R"md(
A bar that a tire rolls over or stands on.

```toml
[cleat]
height = "15 mm"
length = "30 mm"                 # along the road if angle is 0
bevel = "5 mm"                   # of its upper edges, default 0
angle = "30 deg"                 # against the axle, default 0
```
)md",
      .sentences =
          {
              {"height", "Height of the bar."},
              {"length", "Length of the bar, along the road if `angle` is 0."},
              {"bevel",
               "Length of the bevel of its upper edges.",
               "",
               "0 to the height, at most half the length"},
              {"angle",
               "Angle of the bar against the axle, counterclockwise from above: a tire that rolls "
               "meets a bar of a positive angle with its left side first; 0 is across the tread.",
               "",
               "between the limits of the test"},
          },
      .samples = {},
  };
  return section;
}

}  // namespace latsch::experiment
