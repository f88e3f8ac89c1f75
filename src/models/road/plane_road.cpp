// SPDX-License-Identifier: Apache-2.0
#include "models/road/plane_road.h"

#include <algorithm>

namespace latsch::road {

PlaneRoad::PlaneRoad(const Settings& settings)
    : settings_(settings),
      normal_(Eigen::Vector3d(-settings.grade, -settings.bank, 1.0).normalized()),
      forward_(Eigen::Vector3d(1.0, 0.0, settings.grade).normalized()) {}

double PlaneRoad::height(double x, double y, double) const {
  return settings_.height + settings_.grade * x + settings_.bank * y;
}

GroundBounds PlaneRoad::bounds(const GroundBox& box, double time) const {
  const double highest = std::max({height(box.x0, box.y0, time),
                                   height(box.x1, box.y0, time),
                                   height(box.x0, box.y1, time),
                                   height(box.x1, box.y1, time)});
  return {highest, true};
}

GroundPoint PlaneRoad::at(double x, double y, double time) const {
  return {height(x, y, time), normal_, settings_.friction, -settings_.belt.speed(time) * forward_};
}

}  // namespace latsch::road
