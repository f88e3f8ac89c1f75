// SPDX-License-Identifier: Apache-2.0
#include "models/road/kerb.h"

#include <cassert>
#include <cmath>
#include <numbers>

namespace latsch::road {
namespace {

constexpr int kSinePieces = 256;

Profile sine(double pitch, double height) {
  std::vector<Profile::Point> points;
  for (int i = 0; i <= kSinePieces; ++i) {
    const double part = static_cast<double>(i) / kSinePieces;
    points.push_back(
        {part * pitch, height * (1.0 - std::cos(2.0 * std::numbers::pi * part)) / 2.0});
  }
  return Profile(std::move(points));
}

Profile block(const Kerb& kerb) {
  std::vector<Profile::Point> points = cleat_profile(kerb.height, kerb.length, kerb.bevel).points();
  for (Profile::Point& point : points) point.s += kerb.pitch / 2.0;
  points.insert(points.begin(), {0.0, 0.0});
  points.push_back({kerb.pitch, 0.0});
  return Profile(std::move(points));
}

Profile across(const Kerb& kerb) {
  if (kerb.ramp == 0.0) {
    return Profile({{0.0, 0.0}, {0.0, 1.0}, {kerb.width, 1.0}, {kerb.width, 0.0}});
  }
  return Profile({{0.0, 0.0}, {kerb.ramp, 1.0}, {kerb.width - kerb.ramp, 1.0}, {kerb.width, 0.0}});
}

}  // namespace

Profile kerb_profile(const Kerb& kerb) {
  assert(kerb.pitch > 0.0);
  switch (kerb.shape) {
    case Kerb::Shape::saw_tooth:
      return Profile({{0.0, 0.0}, {kerb.pitch, kerb.height}, {kerb.pitch, 0.0}});
    case Kerb::Shape::triangle:
      return Profile({{0.0, 0.0}, {kerb.pitch / 2.0, kerb.height}, {kerb.pitch, 0.0}});
    case Kerb::Shape::sine:
      return sine(kerb.pitch, kerb.height);
    case Kerb::Shape::block:
      return block(kerb);
  }
  return {};
}

ProfileRoad kerb_road(const Kerb& kerb) {
  assert(kerb.width > 0.0 && kerb.count > 0 && kerb.ramp >= 0.0 && kerb.ramp <= kerb.width / 2.0);
  ProfileRoad::Settings settings;
  settings.along = kerb_profile(kerb);
  settings.across = across(kerb);
  settings.pitch = kerb.pitch;
  settings.count = kerb.count;
  settings.origin = kerb.start;
  settings.angle = kerb.angle;
  settings.friction = kerb.road_friction;
  settings.obstacle_friction = kerb.friction;
  return ProfileRoad(settings);
}

}  // namespace latsch::road
