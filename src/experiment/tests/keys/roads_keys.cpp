// SPDX-License-Identifier: Apache-2.0
#include "experiment/language/key_section.h"

namespace latsch::experiment {

const KeySection& roads_keys() {
  static const KeySection section = {
      .heading = "[kerb] of a test, and roads in words",
      .about = R"md(
A road is described by a table, in a file of its own or inline. friction and obstacle_friction
are factors. Keys belong to the kinds of roads that their examples show:

```toml
kind = "flat"                        # friction, height, grade, bank (plain), belt_speed

kind = "cleat"                       # on a flat road or belt
height = "20 mm"                     # negative: a groove
length = "25 mm"
bevel = "5 mm"                       # default 0
angle = "30 deg"                     # of the bar against the axle, counterclockwise; default 0
place = "2 m"                        # x of its middle; default 0

kind = "drum"
diameter = "2.5 m"
inner = false
speed = "60 km/h"                    # or times = ["0 s", ...] and speeds = ["0 km/h", ...]
starting_angle = "180 deg"           # of the first cleat from the tire, against the rotation
cleats = 1                           # equally spaced; height, length, bevel, angle as above

kind = "kerb"                        # shape = "saw_tooth", "triangle", "sine" or "block"
shape = "saw_tooth"
pitch = "800 mm"
width = "800 mm"
height = "-25 mm"                    # negative: depth
count = 4                            # start = ["0 m", "-0.4 m"], angle, ramp, length, bevel

kind = "wave"                        # amplitude, wave_length, start; a sweep: end,
amplitude = "10 mm"                  # amplitude_end, wave_length_end, exponential = true
wave_length = "2 m"
```
)md",
      .sentences =
          {
              {"kind", "Kind of road; the table `[kerb]` of a test is of the kind \"kerb\"."},
              {"friction", "Factor of the friction of the road."},
              {"obstacle_friction", "Factor of the friction of an obstacle on it.", "`friction`"},
              {"belt_speed", "Speed of the belt of a flat road or of one with a cleat."},
              {"height",
               "Height of the road, of the bar or of the kerb; negative: a groove or a depth.",
               "0 for the road, else required"},
              {"length",
               "Length of the bar, or of a block of a kerb.",
               "",
               "above 0; of a block at most the pitch"},
              {"bevel",
               "Length of the bevel of the upper edges.",
               "",
               "0 to the height, at most half the length"},
              {"angle", "Angle of the bar or kerb against the axle, counterclockwise."},
              {"grade", "Grade of a flat road, as a plain number."},
              {"bank", "Bank of a flat road, as a plain number."},
              {"place", "Position x of the middle of the bar."},
              {"diameter", "Diameter of the drum."},
              {"inner", "`true`: the tire rolls on the inner surface."},
              {"speed", "Speed of the drum's surface, or `times` and `speeds`."},
              {"times", "Times at which the drum has the `speeds`."},
              {"speeds", "Speeds of the drum's surface at the `times`."},
              {"cleats",
               "Number of cleats, equally spaced; height, length, bevel and angle are theirs."},
              {"starting_angle", "Angle of the first cleat from the tire, against the rotation."},
              {"shape", "Shape of the kerb."},
              {"pitch", "Pitch of the kerb, from one tooth to the next."},
              {"width", "Width of the kerb."},
              {"count", "Number of teeth."},
              {"ramp", "Length over which the kerb rises at its sides.", "", "0 to half the width"},
              {"start",
               "Beginning: x of a wave; x and y of the right edge of a kerb, in a test counted "
               "from the car's middle, y to the left.",
               "0"},
              {"amplitude", "Amplitude of the wave."},
              {"wave_length", "Length of the wave."},
              {"end", "Position x at which the sweep of waves ends.", "no sweep", "beyond `start`"},
              {"amplitude_end", "Amplitude at the end of the sweep.", "`amplitude`"},
              {"wave_length_end", "Length of the wave at the end of the sweep.", "`wave_length`"},
              {"exponential", "`true`: the length changes exponentially."},
          },
      .samples =
          {
              R"toml(kind = "flat"
friction = 0.9
height = "1 mm"
grade = 0.01
bank = 0.02
belt_speed = "1 m/s"
)toml",
              R"toml(kind = "cleat"
height = "20 mm"
length = "25 mm"
bevel = "5 mm"
angle = "30 deg"
place = "2 m"
)toml",
              R"toml(kind = "drum"
diameter = "2.5 m"
inner = false
speed = "60 km/h"
cleats = 1
height = "20 mm"
length = "25 mm"
bevel = "5 mm"
angle = "30 deg"
starting_angle = "180 deg"
)toml",
              R"toml(kind = "drum"
diameter = "2.5 m"
times = ["0 s", "1 s"]
speeds = ["0 km/h", "60 km/h"]
)toml",
              R"toml(kind = "kerb"
shape = "block"
pitch = "800 mm"
width = "800 mm"
height = "-25 mm"
count = 4
length = "400 mm"
bevel = "10 mm"
ramp = "50 mm"
start = ["0 m", "-0.4 m"]
angle = "2 deg"
friction = 0.9
obstacle_friction = 0.8
)toml",
              R"toml(kind = "wave"
amplitude = "10 mm"
wave_length = "2 m"
start = "1 m"
end = "20 m"
amplitude_end = "5 mm"
wave_length_end = "1 m"
exponential = true
)toml",
          },
  };
  return section;
}

}  // namespace latsch::experiment
