// SPDX-License-Identifier: Apache-2.0
#include "models/fe_tire/mesh/mesh.h"

#include <fmt/format.h>

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>
#include <numbers>

#include "base/error.h"

namespace latsch::fe_tire {
namespace {

constexpr double kSameAngle = 1e-9;  // rad, largest difference between angles that count as equal

/// Returns the rotation that turns (0, 0, -1) toward +x, the direction in which sectors are
/// counted.
Eigen::Matrix3d turn(double theta) {
  const double c = std::cos(theta), s = std::sin(theta);
  Eigen::Matrix3d R;
  R << c, 0, -s, 0, 1, 0, s, 0, c;
  return R;
}

/// Returns six times the volume of the tetrahedron at a corner of an element, spanned by its three
/// edges in right-handed order.
double corner_volume(const Eigen::Matrix<double, 3, 8>& X, int corner) {
  static constexpr int kEdges[8][3] = {
      {1, 3, 4}, {2, 0, 5}, {3, 1, 6}, {0, 2, 7}, {7, 5, 0}, {4, 6, 1}, {5, 7, 2}, {6, 4, 3}};
  const auto& e = kEdges[corner];
  return (X.col(e[0]) - X.col(corner))
      .cross(X.col(e[1]) - X.col(corner))
      .dot(X.col(e[2]) - X.col(corner));
}

std::string where(const Eigen::Matrix<double, 3, 8>& X) {
  const Eigen::Vector3d c = 1e3 * X.rowwise().mean();
  return fmt::format("y = {:.1f} mm, r = {:.1f} mm", c.y(), std::hypot(c.x(), c.z()));
}

void check_element(const Mesh& mesh, int index, std::vector<char>& used) {
  const Element& element = mesh.elements[index];
  const int n = mesh.nodes_per_sector();
  const int limit = mesh.sectors > 1 ? 2 * n : n;
  for (int node : element.node) {
    if (node < 0 || node >= limit)
      throw InputError(fmt::format(
          "mesh: element {} refers to node {}, expected 0 to {}", index, node, limit - 1));
    used[node % n] = 1;
  }
  const auto X = mesh.coordinates(element);
  const double size = (X.col(6) - X.col(0)).norm();
  for (int corner = 0; corner < 8; ++corner) {
    const double volume = corner_volume(X, corner);
    if (!(volume > 1e-9 * size * size * size))
      throw InputError(
          fmt::format("mesh: element {} ({}, region {}) is {} at its corner {}; check contour and "
                      "thickness there",
                      index,
                      where(X),
                      mesh.region_names.at(element.region),
                      volume < 0.0 ? "inverted" : "degenerate",
                      corner));
  }
}

}  // namespace

double Mesh::angle(int plane) const {
  if (theta.empty() || plane == sectors) return 2.0 * std::numbers::pi * plane / sectors;
  return theta[plane];
}

Eigen::Matrix3d Mesh::sector_rotation(int sector) const {
  if (sectors == 1) return Eigen::Matrix3d::Identity();
  return turn(theta.empty() ? angle(1) : angle(sector + 1) - angle(sector));
}

Eigen::Matrix3d Mesh::frame(int sector) const {
  if (sectors == 1) return Eigen::Matrix3d::Identity();
  return turn(angle(sector));
}

Mesh Mesh::evenly_divided() const {
  Mesh mesh = *this;
  mesh.theta.clear();
  return mesh;
}

Eigen::Matrix<double, 3, 8> Mesh::coordinates(const Element& element, int sector) const {
  const Eigen::Matrix3d R = sector_rotation(sector);
  const int n = nodes_per_sector();
  Eigen::Matrix<double, 3, 8> x;
  for (int a = 0; a < 8; ++a) {
    const int node = element.node[a];
    if (node < n)
      x.col(a) = X.col(node);
    else
      x.col(a) = R * X.col(node - n);
  }
  if (element.tie.eta != 0) {
    for (const auto& [lower, upper] : element.tie.pairs()) {
      const Eigen::Vector3d from = x.col(lower), way = x.col(upper) - from;
      x.col(lower) = from + element.tie.lower * way;
      x.col(upper) = from + element.tie.upper * way;
    }
  }
  return x;
}

Corners corners_of(const Mesh& mesh) {
  const int n = mesh.nodes_per_sector();
  Corners corners;
  const auto number_of = [&](const Corners::Tied& corner) {
    if (corner.at == 0.0) return corner.lower;
    if (corner.at == 1.0) return corner.upper;
    const auto known = std::ranges::find(corners.tied, corner);
    const auto index = known - corners.tied.begin();
    if (known == corners.tied.end()) corners.tied.push_back(corner);
    return n + static_cast<int>(index);
  };
  std::vector<std::array<bool, 8>> on_next;
  for (const Element& element : mesh.elements) {
    std::array<int, 8>& own = corners.of_element.emplace_back();
    std::array<bool, 8>& next = on_next.emplace_back();
    for (int a = 0; a < 8; ++a) {
      own[a] = element.node[a] % n;
      next[a] = element.node[a] >= n;
    }
    if (element.tie.eta == 0) continue;
    for (const auto& [lower, upper] : element.tie.pairs()) {
      const int from = own[lower], to = own[upper];
      own[lower] = number_of({from, to, element.tie.lower});
      own[upper] = number_of({from, to, element.tie.upper});
    }
  }
  const int of_plane = n + static_cast<int>(corners.tied.size());
  for (std::size_t e = 0; e < on_next.size(); ++e) {
    for (int a = 0; a < 8; ++a) {
      if (on_next[e][a]) corners.of_element[e][a] += of_plane;
    }
  }
  return corners;
}

double Mesh::outer_radius() const {
  double radius = 0.0;
  for (const Element& element : elements) {
    if (!element.tread) continue;
    for (int a = 4; a < 8; ++a) {
      const auto x = X.col(element.node[a] % nodes_per_sector());
      radius = std::max(radius, std::hypot(x.x(), x.z()));
    }
  }
  return radius;
}

void check(const Mesh& mesh) {
  if (mesh.sectors != 1 && mesh.sectors < 3)
    throw InputError(fmt::format("mesh: {} sectors, expected 1 or at least 3", mesh.sectors));
  for (int s = 0; s < static_cast<int>(mesh.theta.size()); ++s) {
    const bool sound =
        static_cast<int>(mesh.theta.size()) == mesh.sectors && mesh.angle(s + 1) > mesh.angle(s) &&
        std::abs(mesh.angle(s) + mesh.angle(mesh.sectors - s) - 2.0 * std::numbers::pi) <
            kSameAngle;
    if (!sound || mesh.theta[0] != 0.0)
      throw InputError(
          fmt::format("mesh: plane {} of {} stands at {:.6g} deg, expected {} planes ascending "
                      "from 0, the same "
                      "on both sides of the contact",
                      s,
                      mesh.theta.size(),
                      mesh.theta[s] * 180.0 / std::numbers::pi,
                      mesh.sectors));
  }
  if (mesh.elements.empty()) throw InputError("mesh: there are no elements");
  if (!mesh.X.allFinite()) throw InputError("mesh: a node has a coordinate that is not finite");
  for (int index = 0; index < static_cast<int>(mesh.elements.size()); ++index) {
    const Element& element = mesh.elements[index];
    if (element.region < 0 || element.region >= static_cast<int>(mesh.region_names.size()))
      throw InputError(fmt::format("mesh: element {} has no region", index));
  }
  std::vector<char> used(mesh.nodes_per_sector(), 0);
  for (int index = 0; index < static_cast<int>(mesh.elements.size()); ++index)
    check_element(mesh, index, used);
  const auto unused = std::find(used.begin(), used.end(), 0);
  if (unused != used.end())
    throw InputError(fmt::format("mesh: node {} belongs to no element", unused - used.begin()));
  for (const std::vector<int>* nodes : {&mesh.clamped, &mesh.sensors})
    for (int node : *nodes)
      if (node < 0 || node >= mesh.nodes_per_sector())
        throw InputError(fmt::format("mesh: a clamped or sensor node is {}, expected 0 to {}",
                                     node,
                                     mesh.nodes_per_sector() - 1));
  if (!std::is_sorted(mesh.clamped.begin(), mesh.clamped.end()))
    throw InputError("mesh: the clamped nodes are not in ascending order");
}

}  // namespace latsch::fe_tire
