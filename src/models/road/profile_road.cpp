// SPDX-License-Identifier: Apache-2.0
#include "models/road/profile_road.h"

#include <algorithm>
#include <cassert>
#include <cmath>

namespace latsch::road {

ProfileRoad::ProfileRoad(const Settings& settings)
    : settings_(settings), cos_(std::cos(settings.angle)), sin_(std::sin(settings.angle)) {
  assert(!settings_.along.empty() && settings_.pitch >= 0.0 && settings_.count >= 0);
}

ProfileRoad::Place ProfileRoad::locate(double x, double y, double time) const {
  const double forward = x - settings_.origin.x() + settings_.belt.distance(time);
  const double left = y - settings_.origin.y();
  double s = forward * cos_ + left * sin_;
  if (settings_.pitch > 0.0) {
    double number = std::floor(s / settings_.pitch);
    if (settings_.count > 0) number = std::clamp(number, 0.0, settings_.count - 1.0);
    s -= number * settings_.pitch;
  }
  Place place{settings_.along.at(s), {1.0, 0.0}, true};
  place.on_obstacle = s >= settings_.along.begin() && s <= settings_.along.end();
  if (settings_.across) {
    const double t = left * cos_ - forward * sin_;
    place.across = settings_.across->at(t);
    place.on_obstacle =
        place.on_obstacle && t >= settings_.across->begin() && t <= settings_.across->end();
  }
  return place;
}

double ProfileRoad::height(double x, double y, double time) const {
  const Place place = locate(x, y, time);
  return place.along.height * place.across.height;
}

GroundPoint ProfileRoad::at(double x, double y, double time) const {
  const Place place = locate(x, y, time);
  const double along = place.along.slope * place.across.height;   // dz/ds
  const double across = place.along.height * place.across.slope;  // dz/dt
  GroundPoint ground;
  ground.height = place.along.height * place.across.height;
  ground.normal = Eigen::Vector3d(-along * cos_ + across * sin_, -along * sin_ - across * cos_, 1.0)
                      .normalized();
  ground.friction = place.on_obstacle ? settings_.obstacle_friction : settings_.friction;
  ground.velocity.x() = -settings_.belt.speed(time);
  return ground;
}

ProfileRoad cleat_road(double x, double height, double length, double bevel, double angle) {
  ProfileRoad::Settings settings;
  settings.along = cleat_profile(height, length, bevel);
  settings.origin.x() = x;
  settings.angle = angle;
  return ProfileRoad(settings);
}

}  // namespace latsch::road
