// SPDX-License-Identifier: Apache-2.0
#include "experiment/language/key_section.h"

namespace latsch::experiment {

const KeySection& frequency_keys();
const KeySection& pressure_keys();
const KeySection& rolling_state_keys();

const KeySection& rolling_response_keys() {
  static const KeySection section = {
      .heading = "Test \"rolling_response\": relaxation of a rolling tire",
      .about = R"md(
Forces of a finite-element tire that rolls steadily while a slip changes a little and harmonically
([equations](fe_tire_motion.md)): its relaxation. Points of the tread that stick go on to stick, and
those that slide go on to slide. The wheel keeps its speed along the heading. Inertia of the change
is left out, gyroscopic forces included, so frequencies have to be far below the lowest mode of the
tire on the ground; at a frequency near 0 the responses are the slopes of the steady forces.

So a response holds for swings in which hardly any point changes between sticking and sliding. With a
large friction a few sliding points can rule the slope within a hundredth of a degree. `latsch test`
compares the main force at 0 Hz with steady states at 0.1 deg of slip angle, a slip of 0.001, 0.2 deg
of camber and a turn slip of 0.001 1/m to both sides, and says where they differ by more than 5 %,
and over which swing they do not.

Channels, all frequencies of one state and then those of the next: "state" (from 1), "frequency"
(Hz), "path_frequency" (rad/m, of the road); for each slip of `inputs` and each of Fx, Fy, Fz, Mx,
My, Mz in axes W (ISO) four channels, for example "re_Fy_by_alpha" and "im_Fy_by_alpha", real and
imaginary part of the change of Fy by a unit of alpha, "tf_Fy_by_alpha", its size, and
"phase_Fy_by_alpha" (rad, negative if the force lags). "relaxation_side", of Fy by alpha, and
"relaxation_slip", of Fx by kappa, are the lengths sigma (m) of a slip that lags,

```
F = C/(1 + i omega sigma/V),   sigma = -(V/omega) Im F/Re F
```

A tire lags nearly so: near 0.1 rad/m of road the lengths are those of slow changes, and at higher
path frequencies they tell how far this one number carries. `latsch test --html` draws forces and
lengths over the frequency. A study compares them with a measured response by `kind =
"frequency_response"` and `y = "relax/Fy_by_alpha"`, at one state.

Rubber and cords whose file states `prony` or `loss_factor` relax in the steady state; the change
then has their storage moduli at twice the frequency of rotation, and no losses. On tire B with a
loss factor of 0.15 the slopes of Fy by alpha, Mz by alpha and Fx by kappa are then 12 % and 7 %
above and 6 % below those of the steady forces; without losses they are equal.
)md",
      .sentences =
          {
              {"inputs",
               "Slips that change, one at a time: \"alpha\" (the wheel moves to the side), "
               "\"kappa\" (its spin changes, with its centrifugal forces), \"gamma\" (it leans "
               "about the line on the ground through its contact center), \"phit\" (it turns about "
               "the vertical through the wheel center). The spin is held except for kappa.",
               "[\"alpha\", \"kappa\"]"},
              {"axle",
               "Quantity that the rig holds constant: the load, by moving the axle, as in the test "
               "rolling; or the height of the axle, at which Fz changes."},
          },
      .samples =
          {
              R"toml(kind = "rolling_response"
load = "4 kN"
speed = "60 km/h"
friction = 1.0
pressure = "2.6 bar"
inputs = ["alpha", "kappa"]
axle = "height"
frequencies = ["0.3 Hz", "1 Hz", "3 Hz"]
)toml",
              R"toml(kind = "rolling_response"
load = ["2 kN", "4 kN"]
speed = "60 km/h"
alpha = "1 deg"
from = "0.5 Hz"
to = "4 Hz"
step = "0.5 Hz"
)toml",
          },
      .shared = {{"", rolling_state_keys}, {"", frequency_keys}, {"", pressure_keys}},
  };
  return section;
}

}  // namespace latsch::experiment
