// SPDX-License-Identifier: Apache-2.0
// The drum of a test rig, smooth or with cleats, as the road under a wheel with a fixed hub.
//
//   outer: the tire stands on it            inner: the tire rolls within
//            z                                  z
//            ^  θ                               |    . axis at +R
//      . - - | - .                              |
//    .   ----+---->x  surface at z = 0      `   |   '
//   .        | axis at -R                     ` ----+---->x
//
// The axis is parallel to y. The surface touches z = 0 at x = 0, where it moves toward -x at
// `surface.speed`, as below a wheel that rolls toward +x. θ is the angle about the axis from that
// line toward +x. A cleat with starting angle θ0 has its middle at
//   θ = θ0 - distance(t)/R - y tan(angle)/R,
// wound around the drum as a helix, turned by `angle` from the line of the axle, counterclockwise
// seen from above as in profile_road.h. Its section is a Profile over the arc length across the
// bar, wrapped around the drum: corners are at their arc length and height, edges between them are
// straight. At positions where several surfaces lie above each other, such as a flank and the drum,
// the road is the highest one. Beyond |x| = 0.95 R the surface continues as the tangent there,
// without cleats.
#pragma once

#include <string>
#include <vector>

#include "models/road/profile.h"
#include "models/road/road.h"
#include "models/road/travel.h"

namespace latsch::road {

class DrumRoad final : public Road {
 public:
  /// A bar mounted on the drum.
  struct Cleat {
    Profile profile = {};         // heights >= 0: a drum has no grooves
    double starting_angle = 0.0;  // rad
    double angle = 0.0;           // rad, angle to the axle, |angle| < 90 deg
    double friction = 1.0;        // factor by which the tire's own friction is multiplied
  };
  /// Size, surface speed and cleats of the drum.
  struct Settings {
    double diameter = 2.0;           // m, > 0
    bool inner = false;              // true: the tire rolls inside the drum
    Travel surface = {};             // motion of the drum's surface
    double friction = 1.0;           // friction factor beside the cleats
    std::vector<Cleat> cleats = {};  // no cleats by default
  };

  /// Returns an empty text if the cleats are valid, otherwise a message: a cleat is longer than the
  /// drum's circumference, or two cleats overlap.
  static std::string fault(const Settings& settings);
  /// Constructs the drum. The settings must have no fault().
  explicit DrumRoad(const Settings& settings);

  GroundPoint at(double x, double y, double time) const override;
  double height(double x, double y, double time) const override;
  GroundBounds bounds(const GroundBox& box, double time) const override;
  /// Returns the reason why a point is off the drum: |x| > 0.95 R, where a tangent replaces the
  /// drum's surface. Returns an empty text for all other points.
  std::string beyond(double x, double y) const override;

  /// Radius of the drum, m.
  double radius() const { return R_; }

 private:
  struct Surface {
    double z = 0.0;
    double slope = 0.0;  // dz/dx
    int cleat = -1;
  };
  Surface locate(double x, double y, double time) const;
  bool cleat_in(const GroundBox& box, double time, double& highest) const;
  double highest_of(const Cleat& cleat, double x0, double x1, double first, double last) const;
  void raise(int cleat, double x, double y, double turned, Surface& surface) const;

  Settings settings_;
  double R_;
  double up_;  // position of the axis: -1 below the road (outer drum), +1 above it (inner drum)
  double edge_x_, edge_z_;  // m, point from which the tangent replaces the drum
  // Angle from the middle of each cleat beyond which it is not visible, rad.
  std::vector<double> windows_;
};

/// Returns equally spaced cleats that are equal to `first`, with `first` at its starting angle.
std::vector<DrumRoad::Cleat> equally_spaced(int number, const DrumRoad::Cleat& first);

}  // namespace latsch::road
