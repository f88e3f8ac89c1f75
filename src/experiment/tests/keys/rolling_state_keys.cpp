// SPDX-License-Identifier: Apache-2.0
#include "experiment/language/key_section.h"

namespace latsch::experiment {

const KeySection& rolling_state_keys() {
  static const KeySection section = {
      .heading = "states of a rolling tire",
      .about = R"md(
The steady states of the tests "rolling", "rolling_footprint", "rolling_chain" and "rolling_response": lists, with one value for all
states or one for each, or a table.
)md",
      .sentences =
          {
              {"load", "Loads of the wheel, Fz."},
              {"speed",
               "Speeds of the wheel center along the wheel's heading; centrifugal forces act. "
               "Beside "
               "`states` one speed, which replaces the table's column Vx, as `pressure` replaces "
               "p."},
              {"friction",
               "Coefficient of friction with the ground, whatever the pressure and the sliding "
               "speed; "
               "the table [friction] of the tire's file depends on both "
               "([keys](fe_tire_section.md)). With 0 no state may have a slip; the "
               "wheel then spins with its speed over the inflated radius less a third of the "
               "deflection.",
               "that of the tire's file, else 1"},
              {"drum_radius",
               "Radius of a drum below the wheel. Speeds are then those of its surface, slip "
               "angles those of the wheel against it; Fx, Fy and Fz act on the wheel forward, "
               "sideways and away from the drum's axis, and patches are rolled out.",
               "none: flat ground"},
              {"kappa",
               "Slips against the free wheel at the same load, speed and camber; -1 is a locked "
               "wheel.",
               "none: the wheel rolls freely"},
              {"alpha", "Slip angles; a positive one gives a negative Fy.", "0"},
              {"camber", "Inclinations about x, top to the right.", "0"},
              {"turn_slip", "Turn slips, minus the turning rate over the speed.", "0"},
              {"states",
               "Table of states in place of these lists: columns Fz, kappa, alpha, gamma, phit, "
               "Vx, p as for the test steady_states; `{from = \"measurement.run\"}` takes those "
               "of a measurement. Without a column kappa the wheel rolls freely."},
          },
      .samples = {},
  };
  return section;
}

}  // namespace latsch::experiment
