// SPDX-License-Identifier: Apache-2.0
#include "experiment/language/key_section.h"

namespace latsch::experiment {

const KeySection& slip_history_keys() {
  static const KeySection section = {
      .heading = "Test \"slip_history\": slips as recorded, lagging",
      .about = R"md(
Slips as recorded, sample by sample, which the forces of the tire follow.

A Magic Formula lags by its relaxation lengths: of formula 6 from LATERAL_STIFFNESS and
LONGITUDINAL_STIFFNESS, none if these are 0; of 5.2 from PTX1 to PTX3, PTY1 and PTY2. Its channels
are those of steady_states, and the lagged slips "kappa" and "alpha".

A finite-element tire rolls in time ([equations](fe_tire_motion.md)) from the steady state of the
first sample. The rig holds the wheel and moves the ground below it, which comes along with Vx,
sideways with Vx tan(alpha), leans by gamma and rises until it carries Fz; so alpha changes without
turn slip. kappa counts from the free wheel at the load, speed and camber of the moment, and is 0
without a column. The channels are those of its steady_states. The pressure is the mean of the
column p, from which samples may differ by 5 %. A step takes tenths of a second, so a record has at
most 20,000 of them. A tire with [reduced] in its file takes a third of that. Vibrations that the
steps do not follow are damped.

Behind a step of time that is backward, repeated or three times the usual one the forces start
settled.
)md",
      .sentences =
          {
              {"states",
               "Table in a file beside the test: time and the columns of steady_states; `{from = "
               "\"measurement.cornering\"}` takes them as they were measured."},
              {"friction",
               "Friction of a finite-element tire with the ground; a Magic Formula has that of its "
               "coefficients, and refuses it.",
               "`friction` of the tire's file, else 1"},
              {"step",
               "Longest step of time of a finite-element tire; a Magic Formula has no steps, and "
               "refuses it.",
               "20 mm of road"},
          },
      .samples =
          {
              R"toml(kind = "slip_history"
states = "states.csv"
)toml",
              R"toml(kind = "slip_history"
states = "states.csv"
friction = 0.9
step = "1 ms"
)toml",
          },
  };
  return section;
}

}  // namespace latsch::experiment
