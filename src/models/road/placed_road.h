// SPDX-License-Identifier: Apache-2.0
// A road at another position: rotated about z by `angle`, with its origin at `origin`.
#pragma once

#include <memory>

#include "models/road/road.h"

namespace latsch::road {

class PlacedRoad final : public Road {
 public:
  /// Places a road. `angle` is in rad, `origin` in m.
  PlacedRoad(std::shared_ptr<const Road> road, double angle, const Eigen::Vector3d& origin);

  GroundPoint at(double x, double y, double time) const override;
  double height(double x, double y, double time) const override;
  double mean_height(const Eigen::Vector2d& from,
                     const Eigen::Vector2d& to,
                     double time) const override;
  std::string beyond(double x, double y) const override;
  void below(const GroundRow& row, double time, const RowGround& ground) const override;
  GroundBounds bounds(const GroundBox& box, double time) const override;

 private:
  Eigen::Vector2d local(double x, double y) const;

  std::shared_ptr<const Road> road_;
  Eigen::Matrix2d turn_;
  Eigen::Vector3d origin_;
};

}  // namespace latsch::road
