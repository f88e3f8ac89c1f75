// SPDX-License-Identifier: Apache-2.0
#include "experiment/language/key_section.h"

namespace latsch::experiment {

const KeySection& pressure_keys();
const KeySection& rolling_state_keys();

const KeySection& rolling_chain_keys() {
  static const KeySection section = {
      .heading = "Test \"rolling_chain\": around a finite-element tire that rolls",
      .about = R"md(
Motion, strain, stress, stored energy and dissipation of points around a finite-element tire that
rolls steadily ([equations](fe_tire_motion.md)), at places of its section. `latsch test --html`
draws them over the angle, and `--output FILE` writes them as a table.

Channels, all points of one state and one position and then those of the next, one point for each
sector from theta = -180 to 180 deg: "state" (from 1), "position", "theta" (rad, 0 at the contact,
positive in front of it; material moves toward decreasing theta); position "x", "y", "z",
displacement "u_x", "u_y", "u_z" (m), velocity "v_x" ... (m/s) and acceleration "a_x" ... (m/s^2)
of the material in the axes of the wheel, which does not spin; strains "E_rr", "E_tt", "E_yy",
"G_rt", "G_ty", "G_ry" (engineering shear) and stresses "S_rr" ... "S_ry" (Pa, second
Piola-Kirchhoff) in the radial, circumferential and axial axes of the point; "cord_strain",
"cord_stress" (Pa), "cord_force" (N/m, along the cords for each meter across them), 0 on the faces;
"energy" (J/m^3) and "dissipation" (W/m^3) of the solid.
)md",
      .sentences =
          {
              {"position",
               "Positions along the inner face of the wall by its length: 0 in the middle (crown), "
               "1 at the bead at +y, -1 at the other; points lie in the middle of the element "
               "there.",
               "0"},
              {"depth",
               "Depth in the wall: \"inner\" or \"outer\" face, or the name of a layer.",
               "\"outer\""},
          },
      .samples =
          {
              R"toml(kind = "rolling_chain"
load = "4 kN"
speed = "60 km/h"
friction = 1.0
pressure = "2.6 bar"
position = [0, 0.5]
depth = "inner"
)toml",
          },
      .shared = {{"", rolling_state_keys}, {"", pressure_keys}},
  };
  return section;
}

}  // namespace latsch::experiment
