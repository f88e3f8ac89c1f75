// SPDX-License-Identifier: Apache-2.0
#include "experiment/kinds/pictures/rolling_scene.h"

#include <fmt/format.h>

#include <cmath>
#include <numbers>

#include "models/road/plane_road.h"

namespace latsch::experiment {
namespace {

constexpr int kCirclePoints = 72;
// assumed width of the belt over its radius, for a drawing, if the width is unknown
constexpr double kWidthOfRadius = 0.6;

Eigen::Matrix3Xd circle(double radius) {
  Eigen::Matrix3Xd points(3, kCirclePoints);
  for (int k = 0; k < kCirclePoints; ++k) {
    const double phi = 2.0 * std::numbers::pi * k / kCirclePoints;
    points.col(k) << radius * std::cos(phi), 0.0, radius * std::sin(phi);
  }
  return points;
}

/// Returns points around the belt relative to the wheel center.
Eigen::Matrix3Xd belt_of(const Tire& tire, const Eigen::Vector3d& center, double radius) {
  Eigen::Matrix3Xd points = tire.outline();
  if (points.cols() == 0) return circle(radius);
  points.colwise() -= center;
  return points;
}

/// Returns a ribbon of that width along a closed line.
Eigen::Matrix3Xd ribbon(const Eigen::Matrix3Xd& line, double width) {
  Eigen::Matrix3Xd points(3, 2 * line.cols());
  const Eigen::Vector3d half(0.0, 0.5 * width, 0.0);
  for (Eigen::Index k = 0; k < line.cols(); ++k) {
    points.col(2 * k) = line.col(k) - half;
    points.col(2 * k + 1) = line.col(k) + half;
  }
  return points;
}

report::Scene::Mesh ribbon_mesh(const Eigen::Matrix3Xd& points) {
  report::Scene::Mesh mesh{"belt", points, {}, {}, {}};
  const auto count = static_cast<std::uint32_t>(points.cols());
  for (std::uint32_t k = 0; k < count; k += 2) {
    const std::uint32_t a = k, b = k + 1, c = (k + 2) % count, d = (k + 3) % count;
    mesh.triangles.insert(mesh.triangles.end(), {a, b, d, a, d, c});
    mesh.edges.insert(mesh.edges.end(), {a, b, a, c, b, d});
  }
  mesh.parts = {{"belt", 0, count}};
  return mesh;
}

/// Returns each element of the footprint as its rectangle on the ground.
report::Scene::Mesh footprint_mesh(const Footprint& print, double ground) {
  report::Scene::Mesh mesh{
      "footprint",
      Eigen::Matrix3Xd(3, 4 * static_cast<Eigen::Index>(print.elements.size())),
      {},
      {},
      {}};
  Eigen::Index at = 0;
  for (const FootprintElement& e : print.elements) {
    const double x = 0.5 * e.length, y = 0.5 * e.width;
    mesh.points.col(at) << e.x - x, e.y - y, ground;
    mesh.points.col(at + 1) << e.x + x, e.y - y, ground;
    mesh.points.col(at + 2) << e.x + x, e.y + y, ground;
    mesh.points.col(at + 3) << e.x - x, e.y + y, ground;
    for (const int k : {0, 1, 2, 0, 2, 3})
      mesh.triangles.push_back(static_cast<std::uint32_t>(at + k));
    at += 4;
  }
  mesh.parts = {{"footprint", 0, static_cast<std::uint32_t>(2 * print.elements.size())}};
  return mesh;
}

}  // namespace

report::Scene rolling_scene(Tire& tire) {
  constexpr double kDeepest = 0.1;  // share of the radius
  constexpr int kDepths = 3;
  const double radius = tire.free_radius();
  const road::PlaneRoad ground;
  WheelMotion motion;
  motion.center.z() = radius;
  report::Scene scene;
  double width = kWidthOfRadius * radius;
  Eigen::Matrix3Xd free = circle(radius);
  if (tire.settle(motion, ground, 0.0)) free = belt_of(tire, motion.center, radius);
  struct State {
    double depth, load;
    Eigen::Matrix3Xd belt;
    std::optional<Footprint> print;
  };
  std::vector<State> states;
  for (int k = 1; k <= kDepths; ++k) {
    const double depth = kDeepest * radius * k / kDepths;
    motion.center.z() = radius - depth;
    const auto hub = tire.settle(motion, ground, 0.0);
    if (!hub) break;
    states.push_back(
        {depth, hub->force.z(), belt_of(tire, motion.center, radius), tire.footprint()});
    if (states.back().print && states.back().print->width > 0.0) width = states.back().print->width;
  }
  const Eigen::Matrix3Xd at_rest = ribbon(free, width);
  scene.meshes.push_back(ribbon_mesh(at_rest));
  scene.frames.push_back({"free", "belt", at_rest, "", ""});
  for (const State& state : states) {
    const Eigen::Matrix3Xd now = ribbon(state.belt, width);
    std::vector<float> moved;
    if (now.cols() == at_rest.cols())
      for (Eigen::Index k = 0; k < now.cols(); ++k)
        moved.push_back(static_cast<float>(1e3 * (now.col(k) - at_rest.col(k)).norm()));
    scene.frames.push_back({fmt::format("{:.0f} mm deep, {:.0f} N", 1e3 * state.depth, state.load),
                            "belt",
                            now,
                            "displacement",
                            "mm",
                            moved,
                            {},
                            0.0,
                            state.depth - radius});
  }
  if (states.empty() || !states.back().print) return scene;
  const Footprint& print = *states.back().print;
  scene.meshes.push_back(footprint_mesh(print, states.back().depth - radius));
  std::vector<float> pressure;
  for (const FootprintElement& e : print.elements)
    pressure.insert(pressure.end(), 4, static_cast<float>(e.pressure / 1e3));
  scene.frames.push_back({fmt::format("footprint at {:.0f} N", print.load),
                          "footprint",
                          scene.meshes.back().points,
                          "pressure",
                          "kPa",
                          pressure,
                          {},
                          0.0,
                          states.back().depth - radius});
  return scene;
}

}  // namespace latsch::experiment
