// SPDX-License-Identifier: Apache-2.0
// Kerbs of race tracks: one section repeated along the track, with a given width.
//
//   saw_tooth   rises over the pitch, falls back at its end
//   triangle    up over half the pitch, down over the other half
//   sine        height (1 - cos(2π s / pitch)) / 2, by chords of 1/256 of the pitch, with an error
//               of at most 0.004 % of the height
//   block       a bar of `length` in the middle of every pitch, with beveled edges
//
// A negative height is a depth, with the same section below the road. Over the width `ramp` at
// either side the height rises gradually, as on kart tracks.
#pragma once

#include "models/road/profile_road.h"
#include "models/road/triangle_road.h"

namespace latsch::road {

struct Kerb {
  enum class Shape { saw_tooth, triangle, sine, block };

  Shape shape = Shape::saw_tooth;
  double pitch = 0.8;   // m, length of one repetition along the track
  double width = 0.8;   // m, across
  double height = 0.0;  // m; negative: depth
  int count = 4;
  double length = 0.0;  // m, length of the bar of a block
  double bevel = 0.0;   // m, bevel of a block
  double ramp = 0.0;    // m, width of the ramp at either side, at most width / 2
  // Start of the first repetition at its right edge, m.
  Eigen::Vector2d start = Eigen::Vector2d::Zero();
  double angle = 0.0;          // rad, direction of the track in the plane
  double friction = 1.0;       // friction factor on the kerb
  double road_friction = 1.0;  // friction factor beside the kerb
};

/// Returns the height profile of one pitch, starting at s = 0.
Profile kerb_profile(const Kerb& kerb);

ProfileRoad kerb_road(const Kerb& kerb);

/// Returns the kerb as a triangle mesh, for programs that read no other kind of road. The mesh
/// includes level ground: `approach` (m) before and after the kerb, and `beside` (m) on both sides
/// for the car's other wheels (0: none). Vertical flanks fall over 0.01 mm.
TriangleMesh kerb_triangles(const Kerb& kerb, double approach, double beside = 0.0);

}  // namespace latsch::road
