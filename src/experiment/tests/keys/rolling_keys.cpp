// SPDX-License-Identifier: Apache-2.0
#include "experiment/language/key_section.h"

namespace latsch::experiment {

const KeySection& pressure_keys();
const KeySection& rolling_state_keys();

const KeySection& rolling_keys() {
  static const KeySection section = {
      .heading = "Test \"rolling\": steady states of a finite-element tire",
      .about = R"md(
A finite-element tire that rolls steadily on flat ground with Coulomb friction
([equations](fe_tire_motion.md)). States are stated by lists, one value for all or one for each
state, or by a table. Each takes seconds.

Channels, one value for each state, axes W (ISO): "alpha", "gamma" (rad), "kappa" (1), "phit" (1/m),
"Vx" (m/s), "p" (Pa); "Fx", "Fy", "Fz" (N), "Mx", "My", "Mz" (N m); "omega" (rad/s), "R_e" (Vx over
omega), "R_l" (loaded radius), "length", "width" of the patch (m); "drive" (N m, moment of the drive
about the spin axis), "sticking" (share of the load on points that do not slide); "loss_rubber",
"loss_cords" and "loss_friction" (W, lost by the histories of rubbers and cords and by sliding),
"rolling_resistance" (N, their sum over the speed), and "loss.rubber.NAME", "loss.layer.NAME" (W) of
each part; "balance" (W, what the discretization leaves between the power of drive and hub and these
losses).

Rubbers and layers of the tire's file lose power by `loss_factor = 0.15` (from 0.1 to 1000 Hz) or
`prony = [[0.2, "1 ms"]]`, shares of the relaxed modulus and relaxation times; moduli are the
relaxed ones. Rubber and cords relax in the equilibrium, so "Fx" of a free wheel contains their
losses. "balance" is what the discretization misses: on sectors of 6 degrees some percent of the
losses, up to a tenth under a patch of two sectors, and most of them under a shorter one, of which a
warning tells. A tire that states neither has the
rolling resistance of friction alone.
)md",
      .sentences = {},
      .samples =
          {
              R"toml(kind = "rolling"
load = "4 kN"
speed = "60 km/h"
friction = 1.0
pressure = "2.6 bar"
alpha = ["0 deg", "1 deg", "2 deg"]
camber = "1 deg"
turn_slip = "0 1/m"
)toml",
              R"toml(kind = "rolling"
load = ["2 kN", "4 kN"]
speed = "60 km/h"
friction = 0.9
drum_radius = "0.85 m"
kappa = [-0.01, -0.05]
)toml",
              R"toml(kind = "rolling"
states = "states.csv"
speed = "60 km/h"
friction = 1.0
)toml",
          },
      .shared = {{"", rolling_state_keys}, {"", pressure_keys}},
  };
  return section;
}

}  // namespace latsch::experiment
