// SPDX-License-Identifier: Apache-2.0
// A road mirrored in the plane y = 0, for a tire that is the mirror image of another
// (models/tire/mirrored_tire.h).
#pragma once

#include "models/road/road.h"

namespace latsch::road {

class MirroredRoad final : public Road {
 public:
  /// Constructs the mirror image of `road`, which must outlive this object.
  explicit MirroredRoad(const Road& road) : road_(road) {}

  GroundPoint at(double x, double y, double time) const override;
  double height(double x, double y, double time) const override {
    return road_.height(x, -y, time);
  }
  double mean_height(const Eigen::Vector2d& from,
                     const Eigen::Vector2d& to,
                     double time) const override {
    return road_.mean_height({from.x(), -from.y()}, {to.x(), -to.y()}, time);
  }
  std::string beyond(double x, double y) const override { return road_.beyond(x, -y); }
  void below(const GroundRow& row, double time, const RowGround& ground) const override;
  GroundBounds bounds(const GroundBox& box, double time) const override {
    return road_.bounds({box.x0, box.x1, -box.y1, -box.y0}, time);
  }

 private:
  const Road& road_;
};

}  // namespace latsch::road
