// SPDX-License-Identifier: Apache-2.0
// Any road (models/road) as ground below a rolling tire (passing_ground.h).
//
// The heights h over a reference plane are averaged by hats along and across,
//   b(p) = int int (1 - |r|/w)(1 - |s|/w)/w^2  h(p + (r, s)) dr ds,   |r|, |s| < w           (G.4)
// with w the length of an element around the tread, so that b is what the tread's own means (T.1)
// feel, and its slope is bounded. For each moment h is replaced by its means in cells of c = w/12
// along and w/3 across, of which (G.4) is a closed form with continuous slopes. A mean along a cell
// is the road's own (Road::below), exact where the road has one; across, the road in the middle of
// a cell stands for it. A vertical flank across the way then moves through the cells without jumps,
// even if it travels with a belt. A step H across the way is felt within H/1152: its mean in a cell
// misplaces at most H c^2/8, and the hat's slope is 1/w^2.
//
// Distances from the reference plane are those along its normal, to first order in the plane's own
// slope. Lengths of arcs are left out (FeltGround::Place::longer): friction counts its way along
// the plane, which is exact for points that stick, and short by 1 - cos of the slope for points
// that slide.
#pragma once

#include <Eigen/Core>
#include <memory>

#include "models/fe_tire/grip/passing_ground.h"
#include "models/road/road.h"

namespace latsch::fe_tire {

/// A plane over which the heights of a road count.
struct ReferencePlane {
  Eigen::Vector3d origin = Eigen::Vector3d::Zero();  // m, inertial: p = 0
  /// Columns: axes of p, horizontal or rising with the plane, and the plane's upward normal.
  Eigen::Matrix3d axes = Eigen::Matrix3d::Identity();

  /// Makes a plane through a point with this upward normal; the axes are as near to the inertial
  /// ones as they can be.
  static ReferencePlane through(const Eigen::Vector3d& point, const Eigen::Vector3d& normal);
  /// Returns the plane's coordinates of an inertial point, m: p, and the height over the plane.
  Eigen::Vector3d to_plane(const Eigen::Vector3d& point) const {
    return axes.transpose() * (point - origin);
  }
  /// Returns the inertial point of the plane at p, m.
  Eigen::Vector3d point(const Eigen::Vector2d& p) const { return origin + axes.leftCols<2>() * p; }
};

class RoadGround final : public PassingGround {
 public:
  /// Sizes of the ground that a tire may feel, m: half lengths of the tread along and across the
  /// wheel's heading, and w.
  struct Size {
    double along = 0.15, across = 0.12, smooth = 0.01;
  };
  /// The road must outlive the ground.
  RoadGround(const road::Road& road, const ReferencePlane& plane, const Size& size)
      : road_(road), plane_(plane), size_(size) {}

  std::shared_ptr<const FeltGround> below(const WheelPlace& wheel) const override;

 private:
  const road::Road& road_;
  ReferencePlane plane_;
  Size size_;
};

}  // namespace latsch::fe_tire
