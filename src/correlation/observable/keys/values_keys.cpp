// SPDX-License-Identifier: Apache-2.0
#include "experiment/language/key_section.h"

namespace latsch::correlation {

const experiment::KeySection& experiment_keys();
const experiment::KeySection& noise_keys();

const experiment::KeySection& values_keys() {
  static const experiment::KeySection section = {
      .heading = "[experiment.NAME] with kind = \"values\"",
      .below = "experiment.*",
      .about = R"md(
Compares single values of a channel with measured ones that are stated in the study itself: a
stiffness, the length of a footprint, a characteristic number of a suspension.

The error is  d_i = (y_i^mea - y_i^sim) / scale_i,  with the measured value's size as scale
unless given. Of several modes of one name the lowest is meant; a missing mode counts as 0, an
error of 100 %. Frequencies of modes of one n that are too close to be distinguished by their
names are compared in their order.
)md",
      .sentences =
          {
              {"channel",
               "Channel TEST/CHANNEL; of a simulator OUTPUT/QUANTITY. Of a test of kind \"modes\" "
               "it is frequency or damping."},
              {"value", "Measured value."},
              {"values",
               "Measured values, instead of `value`: every value of the channel, or those of "
               "`modes`."},
              {"measurement",
               "File or `[measurement.NAME]`, instead of `value` and `values`: its column of the "
               "channel's name; of a K&C rig's slope also what it is the slope of and by, dz_by_Fz "
               "of its columns dz and Fz."},
              {"of", "Value that is compared if the channel has several.", "all of them"},
              {"scale", "Difference that counts as an error of 100 %.", "the measured value"},
              {"modes",
               "Modes whose values are compared, by their names: `[\"torsional n=0\", \"lateral "
               "n=1\"]`; on the ground \"lateral n=1 s\" or a. A measurement with one row for each "
               "of them has them in this order; of a recording with the columns frequency, n and "
               "type, as `latsch test` writes it, the lowest rows of these names are taken."},
          },
      .samples =
          {
              R"toml([experiment.vertical_stiffness]
kind = "values"
channel = "standing/vertical"
value = "220 N/mm"
scale = "10 N/mm"
[experiment.footprint_length]
kind = "values"
channel = "print/length"
values = ["112 mm", "139 mm"]
[experiment.damping]
kind = "values"
channel = "air/damping"
modes = ["torsional n=0", "lateral n=1"]
values = [0.0902, 0.0695]
[experiment.deepest]
kind = "values"
channel = "print/deflection"
of = "largest"
value = "20 mm"
scale = "1 mm"
[experiment.length]
kind = "values"
channel = "print/length"
measurement = "lengths.csv"
[test.standing]
kind = "static_stiffness"
load = "4 kN"
directions = ["vertical"]
[test.print]
kind = "footprint"
loads = ["2 kN", "4 kN"]
[test.air]
kind = "modes"
)toml",
          },
      .shared = {{"", experiment_keys}, {"", noise_keys}},
  };
  return section;
}

}  // namespace latsch::correlation
