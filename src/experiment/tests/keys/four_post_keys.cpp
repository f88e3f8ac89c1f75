// SPDX-License-Identifier: Apache-2.0
#include "experiment/language/key_section.h"

namespace latsch::experiment {

const KeySection& four_post_keys() {
  static const KeySection section = {
      .heading = "Test \"four_post\": a car on four posts",
      .about = R"md(
A car on four posts that move its wheels up and down.

Its channels: time, forces of the push-rods (pushrod_FL ..., compression positive), of the road
on the tires (Fz_FL ...), accelerations of hubs and body upward, spring travel, heave, roll and
pitch, heights of the posts (post_FL ...). Over frequency: densities psd_pushrod_FL ..., transfer
functions tf_pushrod_FL ..., their phases and coherences. Signs and units: docs/car.md.
)md",
      .sentences =
          {
              {"mode",
               "Motion of the posts in a sweep; in recorded posts the signal that the spectra "
               "refer to."},
              {"from", "Frequency at which the sweep begins."},
              {"to", "Frequency at which it ends."},
              {"duration",
               "Duration of the sweep: at least a period of the lowest frequency, for spectra "
               "two."},
              {"amplitude",
               "Amplitude of the plates, up to the frequency at which they move at the peak "
               "`velocity`."},
              {"velocity", "Peak velocity of the plates, which holds above that frequency."},
              {"posts",
               "Heights of the posts instead of the sweep: `{from = \"measurement.rig\"}` takes "
               "post_FL, post_FR, post_RL, post_RR that were recorded, evenly in time; a file is a "
               "table of them and of time."},
              {"step", "Step of the simulation."},
              {"sample_step",
               "Step of the record, a multiple of `step`: at least 12 samples of a period of the "
               "sweep's highest frequency."},
              {"spectra",
               "`true` adds channels over frequency; in recorded posts to the signal of the mode "
               "that is stated. The car runs a second time, with the posts upside down."},
              {"segment",
               "Segment of Welch's method for densities; 1/segment is the distance of lines.",
               "`\"4 s\"`, or all of a shorter record"},
              {"band", "Lines that are kept, within the posts' record.", "those of the sweep"},
          },
      .samples =
          {
              R"toml(kind = "four_post"
mode = "pitch"
from = "1 Hz"
to = "25 Hz"
duration = "4 s"
amplitude = "3 mm"
velocity = "0.1 m/s"
step = "0.2 ms"
sample_step = "1 ms"
spectra = true
segment = "1 s"
band = ["2 Hz", "20 Hz"]
)toml",
              R"toml(kind = "four_post"
posts = "heights.csv"
mode = "pitch"
step = "0.2 ms"
sample_step = "1 ms"
spectra = true
segment = "1 s"
band = ["2 Hz", "20 Hz"]
)toml",
              R"toml(kind = "four_post"
from = "1 Hz"
to = "25 Hz"
duration = "4 s"
spectra = true
)toml",
          },
  };
  return section;
}

}  // namespace latsch::experiment
