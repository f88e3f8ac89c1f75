// SPDX-License-Identifier: Apache-2.0
#include "models/road/kerb.h"

#include <Eigen/Geometry>
#include <cassert>
#include <cmath>
#include <numbers>

namespace latsch::road {
namespace {

constexpr int kSinePieces = 256;
constexpr double kFlank = 1e-5;  // m, length over which a vertical flank falls in the triangle mesh

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

Profile section_across(const Kerb& kerb) {
  if (kerb.ramp == 0.0) {
    return Profile({{0.0, 0.0}, {0.0, 1.0}, {kerb.width, 1.0}, {kerb.width, 0.0}});
  }
  return Profile({{0.0, 0.0}, {kerb.ramp, 1.0}, {kerb.width - kerb.ramp, 1.0}, {kerb.width, 0.0}});
}

/// Returns the points with steep edges in place of vertical flanks: one point of each flank is
/// moved.
std::vector<Profile::Point> without_flanks(std::vector<Profile::Point> points) {
  for (std::size_t i = 1; i < points.size(); ++i) {
    if (points[i].s - points[i - 1].s >= kFlank) continue;
    // The first point of the flank moves backward: the lower one if the flank rises, the upper one
    // if it falls.
    points[i - 1].s = points[i].s - kFlank;
  }
  return points;
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

TriangleMesh kerb_triangles(const Kerb& kerb, double approach, double beside) {
  assert(approach > kFlank && (beside == 0.0 || beside > kFlank));
  const Profile section = kerb_profile(kerb);
  std::vector<Profile::Point> along{{-approach, 0.0}};
  for (int i = 0; i < kerb.count; ++i) {
    for (Profile::Point point : section.points()) {
      point.s += i * kerb.pitch;
      const Profile::Point& last = along.back();
      if (point.s != last.s || point.z != last.z) along.push_back(point);
    }
  }
  along.push_back({kerb.count * kerb.pitch + approach, 0.0});
  along = without_flanks(std::move(along));
  std::vector<Profile::Point> across{{0.0, 1.0}, {kerb.width, 1.0}};
  if (kerb.ramp > 0.0 || beside > 0.0) across = section_across(kerb).points();
  if (beside > 0.0) {
    across.insert(across.begin(), {-beside, 0.0});
    across.push_back({kerb.width + beside, 0.0});
    across = without_flanks(std::move(across));
  }
  TriangleMesh mesh;
  const Eigen::Rotation2Dd turn(kerb.angle);
  for (const Profile::Point& s : along) {
    for (const Profile::Point& t : across) {
      const Eigen::Vector2d place = kerb.start + turn * Eigen::Vector2d(s.s, t.s);
      mesh.nodes.push_back({place.x(), place.y(), s.z * t.z});
    }
  }
  const int columns = static_cast<int>(across.size());
  for (int row = 0; row + 1 < std::ssize(along); ++row) {
    const bool kerb_here = row > 0 && row + 2 < std::ssize(along);
    const double friction = kerb_here ? kerb.friction : kerb.road_friction;
    for (int column = 0; column + 1 < columns; ++column) {
      const bool is_ground = beside > 0.0 && (column == 0 || column + 2 == columns);
      const double here = is_ground ? kerb.road_friction : friction;
      const int k = row * columns + column;
      mesh.triangles.push_back({{k, k + columns, k + 1}, here});
      mesh.triangles.push_back({{k + 1, k + columns, k + columns + 1}, here});
    }
  }
  return mesh;
}

ProfileRoad kerb_road(const Kerb& kerb) {
  assert(kerb.width > 0.0 && kerb.count > 0 && kerb.ramp >= 0.0 && kerb.ramp <= kerb.width / 2.0);
  ProfileRoad::Settings settings;
  settings.along = kerb_profile(kerb);
  settings.across = section_across(kerb);
  settings.pitch = kerb.pitch;
  settings.count = kerb.count;
  settings.origin = kerb.start;
  settings.angle = kerb.angle;
  settings.friction = kerb.road_friction;
  settings.obstacle_friction = kerb.friction;
  return ProfileRoad(settings);
}

}  // namespace latsch::road
