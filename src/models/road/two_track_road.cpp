// SPDX-License-Identifier: Apache-2.0
#include "models/road/two_track_road.h"

namespace latsch::road {

TwoTrackRoad::TwoTrackRoad(Profile left, Profile right, double friction)
    : left_(std::move(left)), right_(std::move(right)), friction_(friction) {}

GroundPoint TwoTrackRoad::at(double x, double y, double) const {
  const Profile::Value value = (y > 0.0 ? left_ : right_).at(x);
  GroundPoint ground;
  ground.height = value.height;
  ground.normal = Eigen::Vector3d(-value.slope, 0.0, 1.0).normalized();
  ground.friction = friction_;
  return ground;
}

}  // namespace latsch::road
