// SPDX-License-Identifier: Apache-2.0
#include "experiment/language/key_section.h"

namespace latsch::experiment {

const KeySection& kinematics_keys() {
  static const KeySection section = {
      .heading = "Test \"kinematics\": a corner and its axle as rigid links",
      .about = R"md(
A corner as rigid links with its chassis held, and the axle of the corner
and its mirror image.

A wheelbase adds steer_inner, steer_outer and ackermann if the rack is stated. Channels are those
of the wheel in the file and of the axle; names that begin with other_ belong to the other wheel.
Their signs: docs/suspension.md.
)md",
      .sentences =
          {
              {"travel", "Travel of the wheel upward; one for all states, or one each."},
              {"from", "First travel of evenly spaced states, instead of `travel`."},
              {"to", "Last travel."},
              {"points", "Number of states from the first travel to the last."},
              {"rack",
               "Travel of the rack to the left; one for all states, or one each. With a wheelbase "
               "it adds steer_inner, steer_outer and ackermann.",
               "0 without these channels"},
              {"mode",
               "Motion of the other wheel: the same, \"opposed\" against it, \"single\" not at "
               "all."},
              {"at", "Point that travels."},
              {"rates", "`true` adds wheel_rate, ride_rate, ride_frequency."},
              {"anti_roll_bar", "`true` adds arb_angle, arb_ratio."},
              {"outer_share",
               "Share of the lateral force on the wheel that is higher in the chassis: for "
               "force_roll_center_height."},
              {"axle",
               "Axle of the car. With `wheelbase` and `cg_height` the front axle adds anti_dive "
               "and anti_lift, the rear one anti_lift and anti_squat."},
              {"wheelbase", "Distance of the axles."},
              {"cg_height", "Height of the center of mass above the ground."},
              {"brake_share", "Share of this axle in the braking force."},
              {"drive_share",
               "Share of this axle in the driving force; the chassis carries the torque."},
              {"brakes", "Place of the brakes."},
              {"rack_per_turn",
               "Travel of the rack per turn of the steering wheel; it adds steer_ratio."},
          },
      .samples =
          {
              R"toml(kind = "kinematics"
travel = ["-30 mm", "0 mm", "30 mm"]
rack = ["0 mm", "1 mm", "2 mm"]
mode = "opposed"
at = "wheel_center"
rates = true
anti_roll_bar = true
outer_share = 0.6
axle = "rear"
wheelbase = "1.55 m"
cg_height = "300 mm"
brake_share = 0.6
drive_share = 0.1
brakes = "inboard"
rack_per_turn = "85 mm"
)toml",
              R"toml(kind = "kinematics"
from = "-30 mm"
to = "30 mm"
points = 3
rack = "1 mm"
mode = "opposed"
at = "wheel_center"
rates = true
anti_roll_bar = true
outer_share = 0.6
axle = "rear"
wheelbase = "1.5 m"
cg_height = "0.3 m"
brake_share = 0.6
drive_share = 0.1
brakes = "inboard"
rack_per_turn = "85 mm"
)toml",
          },
  };
  return section;
}

}  // namespace latsch::experiment
