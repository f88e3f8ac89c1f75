// SPDX-License-Identifier: Apache-2.0
#include "experiment/kinds/pictures/suspension_scene.h"

#include <cmath>
#include <numbers>

namespace latsch::experiment {
namespace {

constexpr double kTravel = 0.05;  // m, bump and rebound
constexpr double kRack = 0.02;    // m, to either side
constexpr int kRim = 48;          // points of the wheel's circle

/// Returns the points of a corner in the same order for all positions: five links from inner to
/// outer end, wheel center, wheel.
Eigen::Matrix3Xd points_of(const suspension::MovingLinkage& linkage,
                           const suspension::Linkage& at_rest) {
  constexpr int kLinks = suspension::Linkage::kLinks;
  Eigen::Matrix3Xd points(3, 2 * kLinks + 1 + kRim);
  for (int k = 0; k < kLinks; ++k) {
    points.col(2 * k) = linkage.inner(k);
    points.col(2 * k + 1) = linkage.outer(k);
  }
  const Eigen::Vector3d axis = linkage.spin_axis().normalized();
  const Eigen::Vector3d down = linkage.to_contact();
  const Eigen::Vector3d center = linkage.upright().place;
  points.col(2 * kLinks) = center;
  const Eigen::Vector3d middle = center + at_rest.wheel.offset * axis;
  const Eigen::Vector3d radius = down - at_rest.wheel.offset * axis;
  const Eigen::Vector3d ahead = axis.cross(radius);
  for (int k = 0; k < kRim; ++k) {
    const double phi = 2.0 * std::numbers::pi * k / kRim;
    points.col(2 * kLinks + 1 + k) = middle + std::cos(phi) * radius + std::sin(phi) * ahead;
  }
  return points;
}

constexpr std::uint32_t kCenter = 2 * suspension::Linkage::kLinks;
constexpr std::uint32_t kPoints = kCenter + 1 + kRim;  // points of a corner

/// Returns the lines between the points of several corners, which are stored one after the other.
report::Scene::Mesh mesh_of(const Eigen::Matrix3Xd& points) {
  report::Scene::Mesh mesh{"suspension", points, {}, {}, {}};
  for (std::uint32_t first = 0; first < points.cols(); first += kPoints) {
    for (std::uint32_t k = 0; k < kCenter; k += 2)
      mesh.edges.insert(mesh.edges.end(),
                        {first + k, first + k + 1, first + k + 1, first + kCenter});
    for (std::uint32_t k = 0; k < kRim; ++k)
      mesh.edges.insert(mesh.edges.end(),
                        {first + kCenter + 1 + k, first + kCenter + 1 + (k + 1) % kRim});
  }
  return mesh;
}

struct Position {
  const char* name;
  double travel, rack;
};

/// Returns the points of the corners one after the other, each followed by its mirror image if
/// `mirrored`; no columns if a corner does not reach the position.
Eigen::Matrix3Xd corners_at(const std::vector<suspension::CornerGeometry>& corners,
                            bool mirrored,
                            const Position& position) {
  const int sides = mirrored ? 2 : 1;
  Eigen::Matrix3Xd all(3, kPoints * sides * corners.size());
  Eigen::Index at = 0;
  for (const suspension::CornerGeometry& corner : corners) {
    for (int side = 0; side < sides; ++side) {
      suspension::MovingLinkage moving(corner.linkage, suspension::TravelOf::wheel_center);
      // The rack belongs to the front axle. It moves to the left of the car for both wheels, which
      // is to the right for the mirror image.
      const double steered = &corner == &corners.front() ? position.rack : 0.0;
      const double rack = side == 0 ? steered : -steered;
      if ((position.travel != 0.0 || rack != 0.0) && !moving.move_to(position.travel, rack))
        return {};
      Eigen::Matrix3Xd points = points_of(moving, corner.linkage);
      if (side == 1) points.row(1) *= -1.0;
      all.middleCols(at, kPoints) = points;
      at += kPoints;
    }
  }
  return all;
}

report::Scene scene_at(const std::vector<suspension::CornerGeometry>& corners, bool mirrored) {
  constexpr Position kAtRest{"at rest", 0.0, 0.0};
  constexpr Position kMoved[] = {{"bump, 50 mm", kTravel, 0.0},
                                 {"rebound, 50 mm", -kTravel, 0.0},
                                 {"rack 20 mm to the left", 0.0, kRack},
                                 {"rack 20 mm to the right", 0.0, -kRack}};
  report::Scene scene;
  const Eigen::Matrix3Xd points = corners_at(corners, mirrored, kAtRest);
  scene.meshes.push_back(mesh_of(points));
  scene.frames.push_back({kAtRest.name, "suspension", points, "", ""});
  for (const Position& position : kMoved) {
    const Eigen::Matrix3Xd now = corners_at(corners, mirrored, position);
    if (now.cols() == 0) continue;
    std::vector<float> moved;
    for (Eigen::Index k = 0; k < now.cols(); ++k)
      moved.push_back(static_cast<float>(1e3 * (now.col(k) - points.col(k)).norm()));
    scene.frames.push_back({position.name, "suspension", now, "displacement", "mm", moved});
  }
  return scene;
}

}  // namespace

report::Scene suspension_scene(const suspension::CornerGeometry& corner) {
  return scene_at({corner}, false);
}

report::Scene suspension_scene(const std::vector<suspension::CornerGeometry>& axles) {
  return scene_at(axles, true);
}

}  // namespace latsch::experiment
