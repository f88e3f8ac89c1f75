// SPDX-License-Identifier: Apache-2.0
#include "ring_mesh.h"

#include <algorithm>
#include <cmath>

namespace latsch::verification {
namespace {

constexpr double kSamePlace = 1e-9;  // m

int node_at(std::vector<Eigen::Vector3d>& nodes, double radius, double y) {
  const auto same = std::ranges::find_if(nodes, [&](const Eigen::Vector3d& X) {
    return std::abs(X.z() + radius) < kSamePlace && std::abs(X.y() - y) < kSamePlace;
  });
  if (same != nodes.end()) return static_cast<int>(same - nodes.begin());
  nodes.emplace_back(0.0, y, -radius);
  return static_cast<int>(nodes.size()) - 1;
}

}  // namespace

fe_tire::Mesh ring_mesh(const std::vector<SectionBlock>& blocks, int sectors, double clamped) {
  fe_tire::Mesh mesh;
  mesh.sectors = sectors;
  std::vector<Eigen::Vector3d> nodes;
  // Order of the nodes of each element: inner +y, inner -y, outer +y, outer -y.
  std::vector<std::array<int, 4>> corners;
  for (const SectionBlock& block : blocks) {
    for (std::size_t j = 0; j + 1 < block.sides.size(); ++j) {
      for (std::size_t i = 0; i + 1 < block.radii.size(); ++i) {
        corners.push_back({node_at(nodes, block.radii[i], block.sides[j]),
                           node_at(nodes, block.radii[i], block.sides[j + 1]),
                           node_at(nodes, block.radii[i + 1], block.sides[j]),
                           node_at(nodes, block.radii[i + 1], block.sides[j + 1])});
        fe_tire::Element& element = mesh.elements.emplace_back();
        element.solid = block.solid;
        element.region = block.solid;
        element.tread = &block == &blocks.back() && i + 2 == block.radii.size();
      }
    }
    mesh.region_names.resize(std::max<std::size_t>(mesh.region_names.size(), block.solid + 1),
                             "block");
  }
  const int n = static_cast<int>(nodes.size());
  for (std::size_t e = 0; e < corners.size(); ++e) {
    const auto& [a, b, c, d] = corners[e];
    mesh.elements[e].node = {a, a + n, b + n, b, c, c + n, d + n, d};
  }
  mesh.X.resize(3, n);
  for (int k = 0; k < n; ++k) {
    mesh.X.col(k) = nodes[k];
    if (std::abs(nodes[k].z() + clamped) < kSamePlace) mesh.clamped.push_back(k);
  }
  return mesh;
}

fe_tire::Solid linear_solid(double E, double nu, double density) {
  const double G = E / (2.0 * (1.0 + nu)), lambda = E * nu / ((1.0 + nu) * (1.0 - 2.0 * nu));
  return {fe_tire::StVenantKirchhoff::isotropic(G, lambda), density};
}

fe_tire::Mesh free_ring_mesh(int sectors) {
  const std::vector<double> sides = {0.005, 0.0, -0.005};
  return ring_mesh({{{0.2, 0.299}, sides, 0}, {{0.299, 0.301}, sides, 1}}, sectors, 0.2);
}

fe_tire::Materials free_ring_materials(double nu) {
  return {{linear_solid(5.0, 0.0, 1e-8), linear_solid(kFreeRingModulus, nu, kFreeRingDensity)}, {}};
}

fe_tire::Mesh gyro_ring_mesh(int sectors) {
  return ring_mesh({{{0.20, 0.22, 0.24, 0.26, 0.28}, {0.01, -0.01}, 0},
                    {{0.28, 0.29, 0.30}, {0.05, 0.01, -0.01, -0.05}, 1}},
                   sectors,
                   0.20);
}

fe_tire::Materials gyro_ring_materials() {
  return {{linear_solid(1e7, 0.3, 1100.0), linear_solid(5e7, 0.3, 1200.0)}, {}};
}

}  // namespace latsch::verification
