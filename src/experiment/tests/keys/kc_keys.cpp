// SPDX-License-Identifier: Apache-2.0
#include "experiment/language/key_section.h"

namespace latsch::experiment {

const KeySection& kc_histories_keys();

const KeySection& kc_keys() {
  static const KeySection section = {
      .heading = "Test \"kc\": a corner under loads",
      .about = R"md(
A corner on the rig for kinematics and compliance, its chassis and the inboard end
of its push-rod held.

Its channels are the loads and dx, dy, dz, camber, toe, caster relative to the unloaded corner: x
forward, y left, z up; camber with the top outboard, toe with the front inboard, caster with the
top of the kingpin rearward. `latsch test --details FILE` writes the compliance matrix of every
state: dx_by_Fx ... about_z_by_Mz; `--html FILE` draws the loops.
)md",
      .sentences =
          {
              {"at", "Point of the loads and of dx, dy, dz."},
          },
      .samples =
          {
              R"toml(kind = "kc"
Fx = ["0 N", "100 N"]
Fy = ["0 N", "200 N"]
Fz = ["1 kN", "2 kN"]
Mx = "10 N m"
My = "20 N m"
Mz = "30 N m"
at = "wheel_center"
slopes_by = "Fz"
window = ["-5 kN", "5 kN"]
)toml",
              R"toml(kind = "kc"
loads = {from = "measurement.rig"}
)toml",
          },
      .shared = {{"", kc_histories_keys}},
  };
  return section;
}

}  // namespace latsch::experiment
