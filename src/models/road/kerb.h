// SPDX-License-Identifier: Apache-2.0
// Kerbs as tracks have them: one section repeated along the track, of a given width.
//
//   saw_tooth   rises over the pitch, falls back at its end
//   triangle    up over half the pitch, down over the other
//   sine        height (1 - cos(2π s / pitch)) / 2, by chords of 1/256 of the pitch: at most
//               0.004 % of the height away
//   block       a bar of `length` in the middle of every pitch, its edges beveled
//
// A negative height is a depth: the same section below the road. `ramp` at either side brings the
// height up across the width, as kart tracks have it.
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
  double length = 0.0;                              // m, block: of the bar
  double bevel = 0.0;                               // m, block
  double ramp = 0.0;                                // m, at most width / 2
  Eigen::Vector2d start = Eigen::Vector2d::Zero();  // m: begin of the first, right edge
  double angle = 0.0;                               // rad, of the track about z
  double friction = 1.0;                            // factor, on the kerb
  double road_friction = 1.0;                       // factor, beside it
};

/// One pitch, from s = 0.
Profile kerb_profile(const Kerb& kerb);

ProfileRoad kerb_road(const Kerb& kerb);

/// The same as triangles, for programs that read nothing else: level for `approach` (m) before and
/// behind it and for `beside` (m) on both sides, where a car's other wheels are; 0: as wide as the
/// kerb. Flanks fall over 0.01 mm.
TriangleMesh kerb_triangles(const Kerb& kerb, double approach, double beside = 0.0);

}  // namespace latsch::road
