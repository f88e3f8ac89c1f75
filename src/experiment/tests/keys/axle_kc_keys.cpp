// SPDX-License-Identifier: Apache-2.0
#include "experiment/language/key_section.h"

namespace latsch::experiment {

const KeySection& kc_histories_keys();

const KeySection& axle_kc_keys() {
  static const KeySection section = {
      .heading = "Test \"axle_kc\": both wheels of an axle under loads",
      .about = R"md(
Both wheels of a car's axle on the rig for kinematics and compliance, the
chassis held.

Loads and travels of the right wheel are equal to those of the left in mode "parallel" (Fy, Mx
and Mz mirrored) and opposite in mode "opposed"; in mode "single" there is no load, and the pad
holds the wheel at its initial height.

All motion counts from the place of the car's file. Without travel there are no pads: the springs
have no preload there, and Fz is what is added to the wheel's load at rest, so that of a recording
has to be without it. With travel the springs carry the car's weight. The test leaves out the
weight of wheels and uprights, so the force of a pad at no travel is the wheel's load at rest less
that weight; the force of a recording has it. A pad also pulls: where its force and that weight
are negative together, the wheel would lift.

The channels are the stated quantities, rack, and for both wheels dx, dy, dz, camber, toe, caster
(dx_L .. caster_R; signs as in test kc), the springs' extension and the pads' force.
`latsch test --details FILE` writes the 12 x 12 compliance matrix of every state and the
classical compliances, in phase and out of phase; `--html FILE` draws the loops.

Loads are those of the left wheel, of every state or one for all of them; without them they are
zero. Slopes are dz_L_by_Fz, toe_R_by_Fz ...; `loads` takes all that a rig recorded, Fx ... Mz or
Fx_L ... Mz_R.
)md",
      .sentences =
          {
              {"axle", "Axle of the car."},
              {"mode",
               "Load of the right wheel, if loads and travels have no side.",
               "`\"parallel\"`"},
              {"springs", "\"locked\": bars replace the springs."},
              {"at", "Point of the loads and of dx, dy, dz."},
              {"travel",
               "Travel of the left wheel center, by a pad; without it the wheel is free."},
              {"rack", "Travel of the rack to the left.", "0"},
              {"Fx_L, Fy_L, Fz_L, Mx_L, My_L, Mz_L, Fx_R, Fy_R, Fz_R, Mx_R, My_R, Mz_R",
               "Load of one wheel by itself, instead of `mode`, Fx ... Mz and `travel`."},
              {"travel_L, travel_R", "Travel of one wheel by itself."},
          },
      .samples =
          {
              R"toml(kind = "axle_kc"
axle = "front"
mode = "opposed"
springs = "locked"
at = "wheel_center"
Fx = ["0 N", "100 N"]
Fy = ["0 N", "200 N"]
Fz = ["1 kN", "2 kN"]
Mx = "10 N m"
My = "20 N m"
Mz = "30 N m"
travel = "3 mm"
rack = ["1 mm", "2 mm"]
slopes_by = "Fz"
window = ["-5 kN", "5 kN"]
)toml",
              R"toml(kind = "axle_kc"
axle = "front"
springs = "locked"
at = "wheel_center"
rack = ["1 mm", "2 mm"]
Fx_L = ["0 N", "100 N"]
Fy_L = "20 N"
Fz_L = ["1 kN", "2 kN"]
Mx_L = "10 N m"
My_L = "20 N m"
Mz_L = "30 N m"
travel_L = ["1 mm", "2 mm"]
Fx_R = ["0 N", "100 N"]
Fy_R = "20 N"
Fz_R = ["1 kN", "2 kN"]
Mx_R = "10 N m"
My_R = "20 N m"
Mz_R = "30 N m"
travel_R = ["1 mm", "2 mm"]
)toml",
              R"toml(kind = "axle_kc"
axle = "rear"
loads = {from = "measurement.rig"}
)toml",
          },
      .shared = {{"", kc_histories_keys}},
  };
  return section;
}

}  // namespace latsch::experiment
