// SPDX-License-Identifier: Apache-2.0
#include "models/fe_tire/ring/ring.h"

#include <fmt/format.h>

#include <algorithm>
#include <cassert>
#include <cmath>
#include <map>
#include <utility>

namespace latsch::fe_tire {

namespace {

constexpr double kSameWidth = 1e-9;  // rad, largest difference of sector widths that count as equal

/// Returns the first sector of each width, and sets the index of the width of every sector.
std::vector<int> different_sectors(const Mesh& mesh, std::vector<int>& width) {
  std::vector<int> first;
  const auto span = [&](int s) { return mesh.angle(s + 1) - mesh.angle(s); };
  for (int s = 0; s < mesh.sectors; ++s) {
    const auto same = std::ranges::find_if(
        first, [&](int other) { return std::abs(span(s) - span(other)) < kSameWidth; });
    width.push_back(static_cast<int>(same - first.begin()));
    if (same == first.end()) first.push_back(s);
  }
  return first;
}

/// Finds the edges of inner faces that belong to only one inner face and are not held by the rim.
std::vector<std::array<bool, 4>> open_edges(const Mesh& mesh) {
  const int n = mesh.nodes_per_sector();
  // Returns the two ends of an edge. The nodes of a sector's second plane are those of the next
  // sector's first plane.
  const auto ends = [n](const Element& element, int k) -> std::pair<int, int> {
    return std::minmax({element.node[k] % n, element.node[(k + 1) % 4] % n});
  };
  std::map<std::pair<int, int>, int> faces;
  for (const Element& element : mesh.elements) {
    for (int k = 0; k < 4 && element.inner; ++k) ++faces[ends(element, k)];
  }
  const auto is_held = [&](int node) {
    return std::binary_search(mesh.clamped.begin(), mesh.clamped.end(), node);
  };
  std::vector<std::array<bool, 4>> open(mesh.elements.size());
  for (std::size_t e = 0; e < open.size(); ++e) {
    open[e].fill(false);
    for (int k = 0; k < 4 && mesh.elements[e].inner; ++k) {
      const auto [a, b] = ends(mesh.elements[e], k);
      open[e][k] = faces[{a, b}] == 1 && !(is_held(a) && is_held(b));
    }
  }
  return open;
}

/// Computes the shape of an element. Default elements in sectors of a ring are arcs.
HexShape shape_of(const Mesh& mesh, const Element& element, int sector, ElementKind kind) {
  const Matrix38 X = mesh.coordinates(element, sector);
  if (kind != ElementKind::solid_shell || mesh.sectors < 3)
    return make_shape(kind, X, element.wall);
  return make_arc_shape(X, 0.5 * (mesh.angle(sector + 1) - mesh.angle(sector)), element.wall);
}

}  // namespace

Ring::Ring(Mesh mesh, ElementKind kind) : mesh_(std::move(mesh)) {
  check(mesh_);
  for (int sector : different_sectors(mesh_, width_)) {
    Q_.push_back(mesh_.sector_rotation(sector));
    std::vector<HexShape>& shapes = shapes_.emplace_back();
    for (const Element& element : mesh_.elements) {
      shapes.push_back(shape_of(mesh_, element, sector, kind));
    }
  }
  alphas_ = internal_parameters(kind);
  open_edges_ = open_edges(mesh_);
  const int n = mesh_.nodes_per_sector();
  first_dof_.assign(n, 0);
  for (int node : mesh_.clamped) first_dof_[node] = -1;
  for (int& dof : first_dof_) {
    if (dof >= 0) dof = 3 * free_nodes_++;
  }
  for (const Element& element : mesh_.elements) {
    std::array<int, 24> dofs;
    for (int a = 0; a < 8; ++a) {
      const bool next = element.node[a] >= n;
      const int first = first_dof_[element.node[a] - (next ? n : 0)];
      for (int i = 0; i < 3; ++i) {
        dofs[3 * a + i] = first < 0 ? -1 : first + i + (next ? sector_unknowns() : 0);
      }
    }
    local_dofs_.push_back(dofs);
  }
}

Matrix38 Ring::in_element_frame(int sector, int element, Matrix38 u) const {
  const Element& e = mesh_.elements[element];
  const Eigen::Matrix3d& Q = Q_[width_[sector]];
  for (int a = 0; a < 8; ++a) {
    if (e.node[a] >= mesh_.nodes_per_sector()) u.col(a) = Q * u.col(a).eval();
  }
  return u;
}

Matrix38 Ring::gather_axisymmetric(int element, const Eigen::VectorXd& x) const {
  assert(widths() == 1);
  Matrix38 u;
  const std::array<int, 24>& local = local_dofs_[element];
  for (int k = 0; k < 24; ++k) {
    u.data()[k] = local[k] < 0 ? 0.0 : x[local[k] % sector_unknowns()];
  }
  return in_element_frame(0, element, u);
}

void Ring::turn_to_node_frames(int sector, int element, Vector24& f, Matrix24* K) const {
  const Element& e = mesh_.elements[element];
  const Eigen::Matrix3d& Q = Q_[width_[sector]];
  const Eigen::Matrix3d Qt = Q.transpose();
  for (int a = 0; a < 8; ++a) {
    if (e.node[a] < mesh_.nodes_per_sector()) continue;
    f.segment<3>(3 * a) = Qt * f.segment<3>(3 * a).eval();
    if (!K) continue;
    for (int b = 0; b < 8; ++b) {
      K->block<3, 3>(3 * a, 3 * b) = Qt * K->block<3, 3>(3 * a, 3 * b).eval();
      K->block<3, 3>(3 * b, 3 * a) = K->block<3, 3>(3 * b, 3 * a).eval() * Q;
    }
  }
}

Eigen::Matrix3Xd Ring::expand(const Eigen::VectorXd& x) const {
  const int n = mesh_.nodes_per_sector();
  Eigen::Matrix3Xd u = Eigen::Matrix3Xd::Zero(3, n);
  for (int i = 0; i < n; ++i) {
    if (first_dof_[i] >= 0) u.col(i) = x.segment<3>(first_dof_[i]);
  }
  return u;
}

Eigen::VectorXd Ring::compress(const Eigen::Matrix3Xd& u) const {
  Eigen::VectorXd x(sector_unknowns());
  for (int i = 0; i < mesh_.nodes_per_sector(); ++i) {
    if (first_dof_[i] >= 0) x.segment<3>(first_dof_[i]) = u.col(i);
  }
  return x;
}

std::string Ring::place(int element) const {
  const int in_section = element % elements_per_sector();
  return fmt::format("element {} (sector {}, section element {}, {})",
                     element + 1,
                     element / elements_per_sector(),
                     in_section,
                     mesh_.region_names.at(mesh_.elements[in_section].region));
}

}  // namespace latsch::fe_tire
