// SPDX-License-Identifier: Apache-2.0
#include "experiment/language/key_section.h"

namespace latsch::experiment {

const KeySection& pressure_keys();

const KeySection& footprint_keys() {
  static const KeySection section = {
      .heading = "Test \"footprint\": contact patch on the ground",
      .about = R"md(
The footprint of a tire that stands on flat ground.

Channels, one value for each state in their order: "load" (N), "deflection", "length", "width"
(m, the greatest ones), "area" (m^2, including grooves), "mean_pressure" (Pa, load over area),
"peak_pressure" (Pa, the highest reading of a sensor at any position) and "grip_level" (1, the
used share of the friction: the shear forces over the largest possible ones). For `sensors`, all
of one state and then those of the next: "pressure" (Pa), "sensor_x", "sensor_y" (m). A sensor
that is larger than the patch reads less than the mean pressure of the patch.

The rig is tared with the wheel in the air, for every kind of tire: the weight of a belt (GRAVITY of
a .tir, `belt.gravity` of a flexible ring) is neither in its load nor in its forces, so a load is
that of the road on the tire.
)md",
      .sentences =
          {
              {"loads",
               "Loads under which the tire stands; `{from = \"measurement.prints\"}` takes its Fz. "
               "The test states `loads` or `deflections`."},
              {"deflections",
               "Deflections from first touch of the upright tire, instead of `loads`; from a "
               "measurement likewise."},
              {"camber", "Inclination of the wheel about x, top to the right."},
              {"friction",
               "Friction of a finite-element tire with the ground; other tires have theirs in "
               "their own files.",
               "0"},
              {"sensor", "Side of the squares in which pressure is measured."},
              {"sensors",
               "Centers of some squares, x forward, y left of the point below the wheel center; "
               "`{from = \"measurement.mat\"}` takes its x and y.",
               "none"},
              {"elements",
               "Longest elements of a finite-element tire below its tread, around and across; in "
               "the patch of the first millimeters they are around half as long. `[\"1 m\", \"1 "
               "m\"]` is its own mesh, which is four times as fast, with friction ten, but less "
               "exact.",
               "`[\"7 mm\", \"7 mm\"]`"},
          },
      .samples =
          {
              R"toml(kind = "footprint"
loads = ["2 kN", "4 kN"]
camber = "2 deg"
pressure = "2.6 bar"
friction = 0.8
sensor = "10 mm"
sensors = [["1 mm", "2 mm"], ["3 mm", "4 mm"]]
elements = ["7 mm", "8 mm"]
)toml",
              R"toml(kind = "footprint"
deflections = ["5 mm", "10 mm"]
)toml",
          },
      .shared = {{"", pressure_keys}},
  };
  return section;
}

}  // namespace latsch::experiment
