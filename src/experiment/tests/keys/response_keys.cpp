// SPDX-License-Identifier: Apache-2.0
#include "experiment/language/key_section.h"

namespace latsch::experiment {

const KeySection& frequency_keys();
const KeySection& pressure_keys();

const KeySection& response_keys() {
  static const KeySection section = {
      .heading = "Test \"response\": transfer functions",
      .about = R"md(
Response of a finite-element tire at rest to a harmonic motion or force, in the air or standing on
the ground. Points in contact stay in contact, and with friction they stick. Rubber and layers
whose file states `prony` or `loss_factor` have their complex modulus at each frequency.

Channels, one value for each frequency: "frequency" (Hz), and for each output four channels, for
example "re_hub_Fz" and "im_hub_Fz", real and imaginary part of the response to a unit of the
input, "tf_hub_Fz", its size, and "phase_hub_Fz" (rad, positive if the output leads). Outputs are
"hub_Fx" ... "hub_Mz", force and moment of the tire on the rim, which is held, or "rim_x" ...
"rim_about_z", the motion of a rim that moves; on the ground "patch_Fx" ... "patch_Mz", force and
moment of the ground on the tire; "point_1_x" ..., the motion of each of the `points`. Axes are
those of the wheel, level with the ground: x forward, z up; moments are about the wheel center. On
the ground one value of "deflection", "loaded_radius" (m) and "force" (N).
)md",
      .sentences =
          {
              {"load",
               "Load of the standing tire. Without `load` and `deflection` the tire is in the "
               "air."},
              {"deflection", "Deflection of the standing tire, instead of `load`."},
              {"friction",
               "Friction of the tire with the ground. Without it the ground holds the tire only "
               "along its normal; any friction holds all points in contact."},
              {"rim",
               "`held`: the rim moves only as the input `wheel` does. `free`: it is a rigid body "
               "that only the tire holds. `rigid`: it is a rigid body on the springs that `[rim]` "
               "of the tire file states. Mass and inertias come from there, too."},
              {"input",
               "What drives the tire. `ground`: a motion of the ground; `wheel`: a motion of the "
               "wheel whose rim is held; `hub`: a force on a rim that moves; `point`: a force on "
               "the tire, as of a hammer."},
              {"direction",
               "Direction of the input; `about_x` ... is a rotation or a moment about an axis "
               "through the wheel center. `radial`, for a force on a point, points away from the "
               "spin axis."},
              {"at",
               "Point x, y, z on the undeformed tire, in the wheel frame, on which the force of "
               "the input `point` acts: at the nearest node of the outer surface."},
              {"points",
               "Points x, y, z on the undeformed tire, in the wheel frame, whose motion is "
               "recorded; `{from = \"measurement.shapes\"}` takes its x, y, z."},
              {"motion", "What is recorded of points and of a rim that moves."},
          },
      .samples =
          {
              R"toml(kind = "response"
load = "4 kN"
pressure = "2.6 bar"
friction = 0.8
input = "ground"
direction = "z"
from = "5 Hz"
to = "300 Hz"
step = "1 Hz"
)toml",
              R"toml(kind = "response"
deflection = "15 mm"
rim = "free"
input = "point"
at = ["0 mm", "0 mm", "310 mm"]
direction = "radial"
frequencies = ["20 Hz", "40 Hz", "80 Hz"]
points = [["0 mm", "0 mm", "310 mm"]]
motion = "acceleration"
)toml",
          },
      .shared = {{"", frequency_keys}, {"", pressure_keys}},
  };
  return section;
}

}  // namespace latsch::experiment
