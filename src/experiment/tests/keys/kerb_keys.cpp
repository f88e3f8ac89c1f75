// SPDX-License-Identifier: Apache-2.0
#include "experiment/language/key_section.h"

namespace latsch::experiment {

const KeySection& roads_keys();

const KeySection& kerb_keys() {
  static const KeySection section = {
      .heading = "Test \"kerb\": a car over a kerb or on a road",
      .about = R"md(
A car drives straight over a kerb.

Its channels are those of a four-post rig, speed, line, loader_1 .. loader_3, and for areas mean
and standard deviation from time 0 on, area_mean_FL ..., area_spread_FL ..., area_mean,
area_spread. The part of the push-rod forces that the loaders cannot reproduce is in
`unreachable`.
)md",
      .sentences =
          {
              {"speed",
               "Speed of the car; `{from = \"measurement.track\"}` takes its channel speed over "
               "time, counted from where the front axle meets the kerb."},
              {"line",
               "Position of the car's middle to the left of y = 0; from a measurement likewise."},
              {"run_in", "Time of driving before the front axle is at x = 0."},
              {"duration", "Time that is recorded from there."},
              {"step",
               "Step of the simulation: it moves the car by 20 mm and an eighth of the kerb's "
               "pitch at most.",
               "`\"0.0002 s\"`, shorter above 100 m/s"},
              {"sample_step",
               "Step of the record, a multiple of `step`: at least four in a pitch."},
              {"area", "`true` records the contact areas."},
              {"wander", "Wander of the driver; not with a measured speed or line.", "none"},
              {"wander.speed", "Standard deviation from the speed."},
              {"wander.line", "Standard deviation from the line."},
              {"wander.period", "Longest period in both."},
              {"wander.seed", "Number that selects the random course."},
              {"kerb",
               "Kerb as that of `latsch road`, x counted from the front axle's position at time 0.",
               "a level road"},
              {"road", "Road from a file, instead of the kerb."},
              {"road.file", "File beside this one: OpenCRG, .rdf or .toml."},
              {"road.start",
               "Middle of the front axle at time 0, in the file's axes.",
               "the origin"},
              {"road.heading", "Direction of driving, counterclockwise from the file's x axis."},
              {"road.beyond_edge",
               "What happens if a tire leaves the road of the file; \"continue\": .rdf level, "
               "OpenCRG as the file says."},
              {"loaders", "Vertical forces on the chassis.", "none"},
              {"loaders.points", "Points of the forces: x and y at rest."},
              {"loaders.downforce", "Force at each point, downward."},
              {"loaders.pushrods",
               "Instead of `downforce`, forces for which the four pushrod_FL ... are as measured, "
               "low-passed before by the measurement: `{from = \"measurement.track\"}`."},
              {"loaders.stretch",
               "Time over which constant forces have the measured means, with `pushrods`.",
               "the forces follow the measurement"},
          },
      .samples =
          {
              R"toml(kind = "kerb"
speed = "60 m/s"
line = "10 mm"
run_in = "0.1 s"
duration = "0.2 s"
step = "0.2 ms"
sample_step = "1 ms"
area = true
[wander]
speed = "0.5 m/s"
line = "20 mm"
period = "1 s"
seed = 2
[kerb]
kind = "kerb"
shape = "sine"
pitch = "800 mm"
width = "600 mm"
height = "25 mm"
count = 6
ramp = "50 mm"
start = ["0 m", "0.4 m"]
angle = "2 deg"
friction = 0.9
obstacle_friction = 0.8
[loaders]
points = [["2 m", "0.4 m"], ["2 m", "-0.4 m"], ["-0.2 m", "0 m"]]
downforce = ["1 kN", "1 kN", "2 kN"]
)toml",
              R"toml(kind = "kerb"
speed = "20 m/s"
line = "10 mm"
run_in = "0.1 s"
duration = "0.2 s"
step = "0.2 ms"
sample_step = "1 ms"
area = true
[kerb]
kind = "kerb"
shape = "block"
length = "400 mm"
bevel = "10 mm"
pitch = "800 mm"
width = "600 mm"
height = "25 mm"
count = 6
ramp = "50 mm"
start = ["0 m", "0.4 m"]
angle = "2 deg"
friction = 0.9
obstacle_friction = 0.8
)toml",
              R"toml(kind = "kerb"
speed = "20 m/s"
[loaders]
points = [["2 m", "0.4 m"], ["2 m", "-0.4 m"], ["-0.2 m", "0 m"]]
pushrods = {from = "measurement.rig"}
stretch = ["0 s", "0.05 s"]
)toml",
              R"toml(kind = "kerb"
speed = "20 m/s"
[road]
start = ["1 m", "0.1 m"]
heading = "5 deg"
beyond_edge = "continue"
file = "track.crg"
)toml",
              R"toml(kind = "kerb"
speed = "20 m/s"
[road]
start = ["1 m", "0.1 m"]
heading = "5 deg"
beyond_edge = "continue"
file = "track.rdf"
)toml",
              R"toml(kind = "kerb"
speed = "20 m/s"
[road]
start = ["1 m", "0.1 m"]
heading = "5 deg"
beyond_edge = "continue"
file = "track.toml"
)toml",
          },
      .shared = {{"kerb", roads_keys}},
  };
  return section;
}

}  // namespace latsch::experiment
