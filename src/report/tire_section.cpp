// SPDX-License-Identifier: Apache-2.0
#include "report/tire_section.h"

#include <cmath>

namespace latsch::report {
namespace {

// Indices of the nodes of the face xi = -1: inner at -y, inner at +y, outer at +y, outer at -y.
constexpr std::array<int, 4> kSectionNodes = {0, 3, 7, 4};

Eigen::Vector2d of_section(const Eigen::Vector3d& X) { return {X.y(), std::hypot(X.x(), X.z())}; }

}  // namespace

std::vector<Eigen::Vector2d> section_nodes(const fe_tire::Mesh& mesh) {
  std::vector<Eigen::Vector2d> nodes;
  for (int k = 0; k < mesh.nodes_per_sector(); ++k) nodes.push_back(of_section(mesh.X.col(k)));
  return nodes;
}

std::array<Eigen::Vector2d, 4> section_corners(const fe_tire::Element& element,
                                               const std::vector<Eigen::Vector2d>& nodes) {
  std::array<Eigen::Vector2d, 4> corners;
  for (std::size_t k = 0; k < corners.size(); ++k)
    corners[k] = nodes[element.node[kSectionNodes[k]]];
  if (element.tie.eta == 0) return corners;
  Eigen::Vector2d &inner = corners[element.tie.eta < 0 ? 0 : 1],
                  &outer = corners[element.tie.eta < 0 ? 3 : 2];
  const Eigen::Vector2d from = inner, way = outer - inner;
  inner = from + element.tie.lower * way;
  outer = from + element.tie.upper * way;
  return corners;
}

std::array<Eigen::Vector2d, 2> cord_ends(const fe_tire::Mesh& mesh,
                                         const fe_tire::Element& element,
                                         double zeta) {
  const Eigen::Matrix<double, 3, 8> X = mesh.coordinates(element);
  std::array<Eigen::Vector2d, 2> ends;
  for (int k = 0; k < 2; ++k) {
    const Eigen::Vector2d inner = of_section(X.col(k == 0 ? 0 : 3));
    const Eigen::Vector2d outer = of_section(X.col(k == 0 ? 4 : 7));
    ends[k] = 0.5 * (1.0 - zeta) * inner + 0.5 * (1.0 + zeta) * outer;
  }
  return ends;
}

TireSection tire_section(const TirePictures& pictures) {
  const fe_tire::Mesh& mesh = pictures.mesh;
  const auto nodes = section_nodes(mesh);
  TireSection section;
  for (const fe_tire::Element& element : mesh.elements) {
    const auto corners = section_corners(element, nodes);
    section.polygons.push_back(
        {mesh.region_names.empty() ? "" : mesh.region_names.at(element.region),
         {corners.begin(), corners.end()}});
    for (const fe_tire::RebarPlacement& rebar : element.rebars) {
      const auto ends = cord_ends(mesh, element, rebar.zeta);
      const auto layer = static_cast<std::size_t>(rebar.layer);
      section.cords.push_back(
          {layer < pictures.layers.size() ? pictures.layers[layer].name : "cords",
           {ends.begin(), ends.end()}});
    }
  }
  return section;
}

}  // namespace latsch::report
