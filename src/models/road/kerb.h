// SPDX-License-Identifier: Apache-2.0
// Kerbs of race tracks: one section repeated along the track, with a given width.
//
//   saw_tooth   rises over the pitch, falls back at its end
//   triangle    up over half the pitch, down over the other half
//   sine        height (1 - cos(2π s / pitch)) / 2, by chords of 1/256 of the pitch, with an error
//               of at most 0.004 % of the height
//   block       a bar of `length` in the middle of every pitch, with beveled edges
//
// A negative height is a depth: the same section below the road. `ramp` at either side raises the
// height gradually across the width, as on kart tracks.
#pragma once

#include "models/road/profile_road.h"
#include "models/road/triangle_road.h"

namespace latsch::road {

struct Kerb {
  enum class Shape { saw_tooth, triangle, sine, block };

  Shape shape = Shape::saw_tooth;
  double pitch = 0.8;   // m, along the track
  double width = 0.8;   // m, across
  double height = 0.0;  // m; negative: depth
  int count = 4;
  double length = 0.0;                              // m, length of a block's bar
  double bevel = 0.0;                               // m, bevel of a block
  double ramp = 0.0;                                // m, at most width / 2
  Eigen::Vector2d start = Eigen::Vector2d::Zero();  // m, start of the first, right edge
  double angle = 0.0;                               // rad, direction of the track about z
  double friction = 1.0;                            // factor on the kerb
  double road_friction = 1.0;                       // factor beside the kerb
};

/// Returns the profile of one pitch, from s = 0.
Profile kerb_profile(const Kerb& kerb);

ProfileRoad kerb_road(const Kerb& kerb);

/// Returns the kerb as triangles, for programs that read nothing else. They are level for
/// `approach` (m) before and behind the kerb, and for `beside` (m) on both sides, where a car's
/// other wheels are; 0: as wide as the kerb. Flanks fall over 0.01 mm.
TriangleMesh kerb_triangles(const Kerb& kerb, double approach, double beside = 0.0);

}  // namespace latsch::road
