// SPDX-License-Identifier: Apache-2.0
#include "models/road/plane_road.h"

namespace latsch::road {

PlaneRoad::PlaneRoad(const Settings& settings)
    : settings_(settings),
      normal_(Eigen::Vector3d(-settings.grade, -settings.bank, 1.0).normalized()),
      forward_(Eigen::Vector3d(1.0, 0.0, settings.grade).normalized()) {}

double PlaneRoad::height(double x, double y, double) const {
  return settings_.height + settings_.grade * x + settings_.bank * y;
}

GroundPoint PlaneRoad::at(double x, double y, double time) const {
  return {height(x, y, time), normal_, settings_.friction, -settings_.belt.speed(time) * forward_};
}

}  // namespace latsch::road
