// SPDX-License-Identifier: Apache-2.0
// A road is described by a table, in a file of its own or inline:
//
//   kind = "flat"                        # friction, height, grade, bank (plain), belt_speed
//
//   kind = "cleat"                       # on a flat road or belt
//   height = "20 mm"                     # negative: a groove
//   length = "25 mm"
//   bevel = "5 mm"                       # default 0
//   angle = "30 deg"                     # of the bar against the axle, counterclockwise; default 0
//   place = "2 m"                        # x of its middle; default 0
//
//   kind = "drum"
//   diameter = "2.5 m"
//   inner = false
//   speed = "60 km/h"                    # or times = ["0 s", ...] and speeds = ["0 km/h", ...]
//   starting_angle = "180 deg"           # of the first cleat from the tire, against the rotation
//   cleats = 1                           # equally spaced; height, length, bevel, angle as above
//
//   kind = "kerb"                        # shape = "saw_tooth", "triangle", "sine" or "block"
//   shape = "saw_tooth"
//   pitch = "800 mm"
//   width = "800 mm"
//   height = "-25 mm"                    # negative: depth
//   count = 4                            # start = ["0 m", "-0.4 m"], angle, ramp, length, bevel
//
//   kind = "wave"                        # amplitude, wave_length, start; a sweep: end,
//   amplitude = "10 mm"                  # amplitude_end, wave_length_end, exponential = true
//   wave_length = "2 m"
//
// friction (of the road) and obstacle_friction (of an obstacle on it) are factors, default 1.
#pragma once

#include <memory>

#include "base/document.h"
#include "models/road/kerb.h"
#include "models/road/road.h"

namespace latsch::road {

/// Throws InputError naming the place, for unknown keys too.
std::unique_ptr<Road> read_road(const Node& table);

/// True if `kind` is that of a road.
bool is_road(const Node& table);

/// Reads a road of kind "kerb" only.
Kerb read_kerb(const Node& table);

}  // namespace latsch::road
