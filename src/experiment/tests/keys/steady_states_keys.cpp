// SPDX-License-Identifier: Apache-2.0
#include "experiment/language/key_section.h"

namespace latsch::experiment {

const KeySection& steady_states_keys() {
  static const KeySection section = {
      .heading = "Test \"steady_states\": a table of states",
      .about = R"md(
Forces of a tire in a table of states.

A measurement is resolved into numbers when the study is read: Fz is required, quantities that
were not recorded are left out. A journal depends on these numbers, not on the measured forces.

A finite-element tire rolls through the states on flat ground ([equations](fe_tire_motion.md)),
each in seconds, up to 2000 of them. Its kappa counts from the wheel that rolls freely at the same
load, speed, camber and pressure. Without a column kappa it is 0, while the test "rolling" then has
a free wheel. A missing speed is 60 km/h, a missing pressure that of the tire. The channels are
Fx .. Mz, R_e (of the free wheel), R_l, length, width and omega; the others are quantities of the
equations of a Magic Formula. Loads and speeds are above 0, slips from -1 to 5, slip angles up to
80 deg, camber up to 0.5 rad. angles = "tangent" is refused, limits = "off" has no effect.

latsch test computes a table of any length block by block. A file above 16 MB is not copied into
memory, and must not be written to while it is read.
)md",
      .sentences =
          {
              {"states",
               "Table of states in a file beside the test; `{from = \"measurement.cornering\"}` "
               "takes them as they were measured, and `{Fz = \"4 kN\", alpha = [\"0 deg\", \"2 "
               "deg\"]}` states them: Fz and any of kappa, alpha, gamma, phit, Vx, p, each with a "
               "value for all states or one for each."},
              {"limits",
               "\"on\" limits inputs to the ranges of the tire's file and fades them below its "
               "VXLOW."},
              {"angles", "Angles as they are, or \"tangent\": tan(alpha), sin(gamma) instead."},
              {"turn_slip",
               "\"on\" computes forces and moments of turning by phit. The sign of the camber is "
               "then that of the program MFeval, which turns the camber force around; "
               "\"book\" has the sign that keeps it."},
              {"friction",
               "Friction of a finite-element tire with the ground; a Magic Formula has that of its "
               "coefficients, and refuses it.",
               "`friction` of the tire's file, else 1"},
              {"side",
               "Side of the vehicle on which the tire was measured, or the \"other\": the tire "
               "mirrored."},
          },
      .samples =
          {
              R"toml(kind = "steady_states"
states = "states.csv"
limits = "off"
angles = "tangent"
turn_slip = "on"
side = "other"
)toml",
              R"toml(kind = "steady_states"
states = "states.csv"
friction = 0.9
)toml",
              R"toml(kind = "steady_states"
states = {Fz = "4 kN", kappa = 0, alpha = ["0 deg", "2 deg"], gamma = "1 deg", phit = "0 1/m", Vx = "60 km/h", p = "2.4 bar"}
)toml",
          },
  };
  return section;
}

}  // namespace latsch::experiment
