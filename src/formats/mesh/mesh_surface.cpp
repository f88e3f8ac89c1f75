// SPDX-License-Identifier: Apache-2.0
#include "formats/mesh/mesh_surface.h"

#include <Eigen/Geometry>
#include <algorithm>
#include <array>
#include <cmath>
#include <set>

namespace latsch::formats {
namespace {

using fe_tire::Element;
using fe_tire::Mesh;

/// Returns the nodes of a face; nodes of the next sector are mapped to this one.
std::array<int, 4> face_of(const Mesh& mesh, const Element& element, int first) {
  std::array<int, 4> face{};
  for (int a = 0; a < 4; ++a) face[a] = element.node[first + a] % mesh.nodes_per_sector();
  std::sort(face.begin(), face.end());
  return face;
}

bool looks_outward(const Eigen::Matrix<double, 3, 8>& X) {
  const Eigen::Vector3d normal = (X.col(6) - X.col(4)).cross(X.col(7) - X.col(5)).normalized();
  const Eigen::Vector3d middle = X.rightCols<4>().rowwise().mean();
  return normal.dot(Eigen::Vector3d(middle.x(), 0.0, middle.z()).normalized()) > std::sqrt(0.5);
}

}  // namespace

void mark_tread(Mesh& mesh) {
  // outer faces that coincide with a face of another element, so they are not free
  std::set<std::array<int, 4>> covered;
  for (const Element& element : mesh.elements) covered.insert(face_of(mesh, element, 0));
  for (Element& element : mesh.elements)
    element.tread =
        !covered.count(face_of(mesh, element, 4)) && looks_outward(mesh.coordinates(element));
}

std::vector<int> choose_sensors(const Mesh& mesh) {
  std::set<int> inner, outer, tread;
  for (const Element& element : mesh.elements)
    for (int a = 0; a < 8; ++a) {
      const int node = element.node[a] % mesh.nodes_per_sector();
      (a < 4 ? inner : outer).insert(node);
      if (a >= 4 && element.tread) tread.insert(node);
    }
  for (int node : inner) outer.erase(node);
  if (outer.empty()) return {};
  const auto y = [&](int node) { return mesh.X(1, node); };
  const auto less = [&](int a, int b) { return y(a) < y(b); };
  const auto nearer = [&](int a, int b) { return std::abs(y(a)) < std::abs(y(b)); };
  const auto [right, left] = std::minmax_element(outer.begin(), outer.end(), less);
  std::vector<int> sensors = {*left};
  if (!tread.empty()) {
    const auto [low, high] = std::minmax_element(tread.begin(), tread.end(), less);
    const auto crown = std::min_element(tread.begin(), tread.end(), nearer);
    sensors.insert(sensors.end(), {*high, *crown, *low});
  }
  sensors.push_back(*right);
  return sensors;
}

}  // namespace latsch::formats
