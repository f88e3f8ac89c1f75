// SPDX-License-Identifier: Apache-2.0
// The rigid surface on which the tire rolls: flat ground, or a drum below the tire.
//
// On the drum a point has the coordinates of the surface rolled out flat: the arc from the drum's
// top line, the place along the drum's axis, and the height over the surface. Arc and place are
// turned into the axes of the wheel's heading, so that friction (F.1) is that of flat ground:
//   q = surface(x, y) + z n                                                                   (G.2)
// where the surface moves with one velocity in x and y. Ground that is not smooth
// (passing_ground.h) raises it: z is then the distance from the raised surface, to first order, and
// arcs include those of its slopes.
#pragma once

#include <Eigen/Core>

#include "models/fe_tire/grip/passing_ground.h"

namespace latsch::fe_tire {

class RollingSurface {
 public:
  /// A drum with this curvature, 1/m, whose top line touches the plane z = 0 of the ground's axes
  /// below the wheel center; 0: flat ground. The drum's surface moves, seen from the wheel, along
  /// the horizontal unit vector `along`.
  RollingSurface(double curvature, const Eigen::Vector2d& along);
  /// Raises the surface by the ground that a wheel at this place feels, which must outlive it.
  void set_ground(const FeltGround& ground, const WheelPlace& wheel);

  struct Place {
    Eigen::Vector3d x;  // m, rolled out: x, y, and the height z over the surface
    /// Turns a vector from the ground's axes to those of the surface at this place: x, y along it,
    /// and its normal.
    Eigen::Matrix3d turn;
  };
  /// Returns the place of a point q, m, in the ground's axes, above the drum's axis.
  Place place(const Eigen::Vector3d& q) const;
  /// Returns the point of the surface, m, ground's axes, at x, y of the surface rolled out.
  Eigen::Vector3d point(const Eigen::Vector2d& x) const;

  bool is_flat() const { return curvature_ == 0.0; }

 private:
  Place on_drum(const Eigen::Vector3d& q) const;
  void add_ground(Place& place) const;

  double curvature_;
  const FeltGround* ground_ = nullptr;  // none: the surface is smooth
  Eigen::Vector2d way_ = Eigen::Vector2d::Zero();
  Eigen::Matrix2d to_ground_;  // turns the axes of the wheel's heading to those of the ground
  Eigen::Matrix2d heading_;    // columns: across the drum's axis, and along it
};

}  // namespace latsch::fe_tire
