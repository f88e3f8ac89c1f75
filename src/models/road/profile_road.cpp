// SPDX-License-Identifier: Apache-2.0
#include "models/road/profile_road.h"

#include <algorithm>
#include <cassert>
#include <cmath>
#include <limits>

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

/// A plane where the whole box is beside the sections or on one straight piece of an endless one.
GroundBounds ProfileRoad::bounds(const GroundBox& box, double time) const {
  const double shift = settings_.belt.distance(time) - settings_.origin.x();
  double s0 = std::numeric_limits<double>::infinity(), s1 = -s0;
  for (const double x : {box.x0, box.x1})
    for (const double y : {box.y0, box.y1}) {
      const double s = (x + shift) * cos_ + (y - settings_.origin.y()) * sin_;
      s0 = std::min(s0, s);
      s1 = std::max(s1, s);
    }
  if (settings_.pitch > 0.0) {
    const double number = std::floor(s0 / settings_.pitch);
    // Near the first and the last of a row of sections nothing is promised but the height.
    if (settings_.count > 0 || std::floor(s1 / settings_.pitch) != number)
      return {settings_.along.reach(), false};
    s0 -= number * settings_.pitch;
    s1 -= number * settings_.pitch;
  }
  return bounds_between(s0, s1);
}

GroundBounds ProfileRoad::bounds_between(double s0, double s1) const {
  if (s1 < settings_.along.begin()) {
    const double z = settings_.along.at(s1).height;
    return {settings_.across ? std::max(z, 0.0) : z, !settings_.across || z == 0.0};
  }
  if (s0 > settings_.along.end()) {
    const double z = settings_.along.at(s0).height;
    return {settings_.across ? std::max(z, 0.0) : z, !settings_.across || z == 0.0};
  }
  double highest = std::max(settings_.along.at(s0).height, settings_.along.at(s1).height);
  bool piece = s0 > settings_.along.begin() && s1 < settings_.along.end();
  for (const Profile::Point& corner : settings_.along.points())
    if (corner.s >= s0 && corner.s <= s1) {
      highest = std::max(highest, corner.z);
      piece = false;
    }
  return {settings_.across ? settings_.along.reach() : highest, piece && !settings_.across};
}

ProfileRoad cleat_road(double x, double height, double length, double bevel, double angle) {
  ProfileRoad::Settings settings;
  settings.along = cleat_profile(height, length, bevel);
  settings.origin.x() = x;
  settings.angle = angle;
  return ProfileRoad(settings);
}

}  // namespace latsch::road
