// SPDX-License-Identifier: Apache-2.0
#include "experiment/language/key_section.h"

namespace latsch::experiment {

const KeySection& pressure_keys();
const KeySection& cleat_keys();

const KeySection& static_stiffness_keys() {
  static const KeySection section = {
      .heading = "Test \"static_stiffness\": of a standing tire",
      .about = R"md(
Standing tire: force over deflection, on flat ground or on a cleat below its middle; stiffness
along, across and about the vertical under a load on flat ground. For any tire.

The axle is moved slowly from its standing position and held; the stiffness is the change of the
hub's force over the displacement, including the friction in the patch.

Deflections are pressed on the `[cleat]`, if there is one, else on flat ground; an angle of 90
deg turns the cleat from across the tread to along it.

The rig is tared with the wheel in the air, for every kind of tire: the weight of a belt (GRAVITY of
a .tir, `belt.gravity` of a flexible ring) is neither in its load nor in its forces, so a load is
that of the road on the tire.
)md",
      .sentences =
          {
              {"deflections",
               "Deflections to which the tire is pressed: channels \"deflection\" and \"force\". "
               "`{from = \"measurement.pressed\"}` takes them as they were measured."},
              {"load",
               "Load, instead of `deflections`: a channel of one value for each direction. The "
               "mean of the channel Fz if it comes from a measurement."},
              {"directions",
               "Directions of the stiffnesses under `load`, of \"vertical\", \"longitudinal\", "
               "\"lateral\" and \"torsional\".",
               "all of them"},
              {"camber", "Inclination of the wheel about x, top to the right."},
              {"friction",
               "Friction of a finite-element tire with the ground; other tires have theirs in "
               "their own files.",
               "0"},
              {"travel", "Travel over which a stiffness is computed, at most 50 mm."},
              {"twist", "Angle over which the torsional stiffness is computed, at most 0.1 rad."},
          },
      .samples =
          {
              R"toml(kind = "static_stiffness"
deflections = ["10 mm", "20 mm"]
pressure = "2.6 bar"
friction = 0.8
travel = "2 mm"
twist = "0.2 deg"
[cleat]
height = "20 mm"
length = "50 mm"
bevel = "5 mm"
angle = "90 deg"
)toml",
              R"toml(kind = "static_stiffness"
load = "4 kN"
directions = ["vertical", "lateral"]
camber = "1 deg"
)toml",
          },
      .shared = {{"", pressure_keys}, {"cleat", cleat_keys}},
  };
  return section;
}

}  // namespace latsch::experiment
