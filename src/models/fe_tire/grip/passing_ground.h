// SPDX-License-Identifier: Apache-2.0
// Ground that is not smooth, as the tread of a rolling tire feels it: heights over a reference
// plane, or over a drum.
//
// A point of the tread is a mean of the surface by hat functions as wide as the elements
// (tread_surface.h), so the ground below it is a mean of the same kind, with a slope that is
// bounded. The ground does not move in the coordinates p of the plane; the wheel travels over it.
// On a drum, p are the coordinates of the drum's surface rolled out.
#pragma once

#include <Eigen/Core>
#include <memory>

namespace latsch::fe_tire {

/// Place and heading of a wheel over the ground at one moment.
struct WheelPlace {
  Eigen::Vector2d way = Eigen::Vector2d::Zero();  // m, p of the point below the wheel center
  double heading = 0.0;  // rad, of the wheel's x from that of p, counterclockwise from above
  double time = 0.0;     // s
};

/// Returns the place at this share, 0 to 1, of the path from a to b.
inline WheelPlace between(const WheelPlace& a, const WheelPlace& b, double share) {
  return {a.way + share * (b.way - a.way),
          a.heading + share * (b.heading - a.heading),
          a.time + share * (b.time - a.time)};
}

/// The ground around a wheel at one moment.
class FeltGround {
 public:
  virtual ~FeltGround() = default;
  struct Place {
    double height = 0.0;                              // m, over the plane or the drum
    Eigen::Vector2d slope = Eigen::Vector2d::Zero();  // derivatives of the height by p
    /// Length of the surface's arcs less their length on the plane, m. Friction counts its way
    /// along arcs; where they are not known, 0 lets it count along the plane.
    Eigen::Vector2d longer = Eigen::Vector2d::Zero();
  };
  virtual Place at(const Eigen::Vector2d& p) const = 0;
  /// Returns the p at which p + at(p).longer is `arc`, m.
  virtual Eigen::Vector2d at_arc(const Eigen::Vector2d& arc) const { return arc; }
};

/// Ground over which a tire passes.
class PassingGround {
 public:
  virtual ~PassingGround() = default;
  /// Returns the ground around a wheel. It must not outlive this object.
  virtual std::shared_ptr<const FeltGround> below(const WheelPlace& wheel) const = 0;
};

}  // namespace latsch::fe_tire
