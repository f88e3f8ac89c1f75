// SPDX-License-Identifier: Apache-2.0
#include "models/fe_tire/ring/ring_unknowns.h"

#include <algorithm>
#include <cmath>
#include <map>

namespace latsch::fe_tire {
namespace {

constexpr double kSamePlace = 1e-7;  // m, largest distance of a node from the position of its image
// Largest difference of material constants that count as equal, relative or in SI units.
constexpr double kSameValue = 1e-9;

/// Signs of the displacement components of a node's image under the half turn, in sector frames.
const Eigen::Vector3d kTurn(-1.0, -1.0, 1.0);

std::optional<std::vector<int>> mirrored_nodes(const Mesh& mesh) {
  const int n = mesh.nodes_per_sector();
  std::vector<int> mirror(n, -1);
  for (int i = 0; i < n; ++i) {
    // A tire with nodes outside its section planes has no such symmetry.
    if (std::abs(mesh.X(0, i)) > kSamePlace) return std::nullopt;
    const Eigen::Vector3d image(0.0, -mesh.X(1, i), mesh.X(2, i));
    for (int j = 0; j < n && mirror[i] < 0; ++j) {
      if ((mesh.X.col(j) - image).squaredNorm() < kSamePlace * kSamePlace) mirror[i] = j;
    }
    if (mirror[i] < 0) return std::nullopt;
  }
  const auto clamped = [&](int i) {
    return std::binary_search(mesh.clamped.begin(), mesh.clamped.end(), i);
  };
  for (int i = 0; i < n; ++i) {
    if (clamped(i) != clamped(mirror[i])) return std::nullopt;
  }
  return mirror;
}

/// Returns the stiffness D after a half turn about the radial axis, which reverses the
/// circumferential and the axial direction.
Matrix6 turned(const Matrix6& D) {
  Vector6 sign;
  // The components 12 and 13 couple the radial direction with a reversed one.
  sign << 1, 1, 1, -1, 1, -1;
  return sign.asDiagonal() * D * sign.asDiagonal();
}

bool same(double a, double b) { return std::abs(a - b) <= kSameValue * (1.0 + std::abs(a)); }

bool same_solid(const Solid& a, const Solid& b) {
  if (!same(a.density, b.density) || a.law.index() != b.law.index()) return false;
  if (const auto* rubber = std::get_if<Hyperelastic>(&a.law)) {
    const auto& other = std::get<Hyperelastic>(b.law);
    return same(rubber->C10, other.C10) && same(rubber->C01, other.C01) && same(rubber->K, other.K);
  }
  const Matrix6 &D = std::get<StVenantKirchhoff>(a.law).D,
                &E = std::get<StVenantKirchhoff>(b.law).D;
  return (D - turned(E)).norm() <= kSameValue * D.norm();
}

bool same_layer(const CordLayer& a, const CordLayer& b) {
  return same(a.E_tension, b.E_tension) && same(a.E_compression, b.E_compression) &&
         same(a.thickness, b.thickness) && same(a.angle, b.angle) &&
         same(a.pretension, b.pretension) && same(a.density, b.density);
}

bool same_element(const Element& a, const Element& b, const Materials& materials) {
  if (a.inner != b.inner || a.tread != b.tread || a.rebars.size() != b.rebars.size()) return false;
  if (a.tie.eta != -b.tie.eta || !same(a.tie.lower, b.tie.lower) ||
      !same(a.tie.upper, b.tie.upper) || !same(a.wall, b.wall)) {
    return false;
  }
  for (std::size_t k = 0; k < a.rebars.size(); ++k) {
    if (!same(a.rebars[k].zeta, b.rebars[k].zeta)) return false;
    if (!same_layer(materials.layers[a.rebars[k].layer], materials.layers[b.rebars[k].layer])) {
      return false;
    }
  }
  return same_solid(materials.solids[a.solid], materials.solids[b.solid]);
}

/// Returns the sorted nodes of an element, or of its image. The half turn exchanges the sector's
/// own section plane and the next one.
std::array<int, 8> sorted_nodes(const Element& element, int n, const std::vector<int>* mirror) {
  std::array<int, 8> nodes = element.node;
  if (mirror) {
    for (int& node : nodes) node = node < n ? (*mirror)[node] + n : (*mirror)[node - n];
  }
  std::sort(nodes.begin(), nodes.end());
  return nodes;
}

}  // namespace

std::optional<std::vector<int>> find_mirror(const Mesh& mesh, const Materials& materials) {
  if (mesh.sectors < 4 || mesh.sectors % 2 != 0) return std::nullopt;
  const std::optional<std::vector<int>> mirror = mirrored_nodes(mesh);
  if (!mirror) return std::nullopt;
  const int n = mesh.nodes_per_sector();
  std::map<std::array<int, 8>, const Element*> by_nodes;
  for (const Element& element : mesh.elements)
    by_nodes[sorted_nodes(element, n, nullptr)] = &element;
  for (const Element& element : mesh.elements) {
    const auto image = by_nodes.find(sorted_nodes(element, n, &*mirror));
    if (image == by_nodes.end() || !same_element(element, *image->second, materials)) {
      return std::nullopt;
    }
  }
  return mirror;
}

RingUnknowns::RingUnknowns(const Ring& ring, RingSymmetry symmetry, const std::vector<int>& mirror)
    : ring_(ring), symmetry_(symmetry) {
  const bool whole = symmetry == RingSymmetry::none;
  sectors_ = whole ? ring.sectors() : ring.sectors() / 2;
  planes_ = whole ? sectors_ : sectors_ + 1;
  if (!whole) mirror_ = mirror;
  number(mirror_);
}

void RingUnknowns::number(const std::vector<int>& mirror) {
  const int n = ring_.mesh().nodes_per_sector();
  const double parity = symmetry_ == RingSymmetry::odd ? -1.0 : 1.0;
  nodes_.resize(static_cast<std::size_t>(planes_) * n);
  for (int plane = 0; plane < planes_; ++plane) {
    const bool own_image = symmetry_ != RingSymmetry::none && (plane == 0 || plane == sectors_);
    for (int i = 0; i < n; ++i) {
      NodeUnknowns& node = nodes_[plane * n + i];
      if (ring_.sector_dof(i) < 0) continue;
      if (own_image && mirror[i] < i) {
        node = nodes_[plane * n + mirror[i]];
        node.sign = parity * kTurn;
        continue;
      }
      node.first = size_;
      size_ += 3;
      if (!own_image || mirror[i] != i) continue;
      for (int k = 0; k < 3; ++k) {
        if (parity * kTurn[k] > 0.0) continue;  // on the axis of the half turn u = -u, so u is zero
        node.sign[k] = 0.0;
        held_.push_back(node.first + k);
      }
    }
  }
}

const RingUnknowns::NodeUnknowns& RingUnknowns::at(int plane, int node) const {
  return nodes_[(plane == planes_ ? 0 : plane) * ring_.mesh().nodes_per_sector() + node];
}

std::vector<std::vector<int>> RingUnknowns::connectivity() const {
  const int n = ring_.mesh().nodes_per_sector();
  std::vector<std::vector<int>> lists;
  for (int s = 0; s < sectors_; ++s) {
    for (const Element& element : ring_.mesh().elements) {
      std::vector<int>& dofs = lists.emplace_back();
      for (int node : element.node) {
        const NodeUnknowns& unknowns = node < n ? at(s, node) : at(s + 1, node - n);
        for (int k = 0; k < 3; ++k) dofs.push_back(unknowns.first < 0 ? -1 : unknowns.first + k);
      }
    }
  }
  return lists;
}

RingUnknowns::NodeUnknowns RingUnknowns::of_node(int plane, int node) const {
  if (plane < planes_) return at(plane, node);
  NodeUnknowns image = at(ring_.sectors() - plane, mirror_[node]);
  const double parity = symmetry_ == RingSymmetry::odd ? -1.0 : 1.0;
  image.sign = parity * kTurn.cwiseProduct(image.sign);
  return image;
}

Matrix38 RingUnknowns::gather(int sector, int element, const Eigen::VectorXd& x) const {
  const int n = ring_.mesh().nodes_per_sector();
  Matrix38 u;
  for (int a = 0; a < 8; ++a) {
    const int node = ring_.mesh().elements[element].node[a];
    const NodeUnknowns& unknowns = node < n ? at(sector, node) : at(sector + 1, node - n);
    if (unknowns.first < 0) {
      u.col(a).setZero();
    } else {
      u.col(a) = unknowns.sign.cwiseProduct(x.segment<3>(unknowns.first));
    }
  }
  return ring_.in_element_frame(sector, element, u);
}

void RingUnknowns::bring_in_order(int sector, int element, Matrix24& K) const {
  // Only the section planes on the axis of the half turn contain the images of their own nodes.
  if (symmetry_ == RingSymmetry::none || (sector > 0 && sector + 1 < sectors_)) return;
  const int n = ring_.mesh().nodes_per_sector();
  for (int a = 0; a < 8; ++a) {
    const int node = ring_.mesh().elements[element].node[a];
    const NodeUnknowns& unknowns = node < n ? at(sector, node) : at(sector + 1, node - n);
    if (unknowns.first < 0 || unknowns.sign == Eigen::Vector3d::Ones()) continue;
    for (int k = 0; k < 3; ++k) {
      K.row(3 * a + k) *= unknowns.sign[k];
      K.col(3 * a + k) *= unknowns.sign[k];
    }
  }
}

void RingUnknowns::add_forces(int sector,
                              int element,
                              const Vector24& f,
                              Eigen::Ref<Eigen::VectorXd> sum) const {
  const int n = ring_.mesh().nodes_per_sector();
  for (int a = 0; a < 8; ++a) {
    const int node = ring_.mesh().elements[element].node[a];
    const NodeUnknowns& unknowns = node < n ? at(sector, node) : at(sector + 1, node - n);
    if (unknowns.first < 0) continue;
    sum.segment<3>(unknowns.first) += unknowns.sign.cwiseProduct(f.segment<3>(3 * a));
  }
}

Eigen::Matrix3Xd RingUnknowns::expand(const Eigen::VectorXd& x) const {
  const int n = ring_.mesh().nodes_per_sector(), S = ring_.sectors();
  const double parity = symmetry_ == RingSymmetry::odd ? -1.0 : 1.0;
  Eigen::Matrix3Xd u = Eigen::Matrix3Xd::Zero(3, S * n);
  for (int plane = 0; plane < planes_; ++plane) {
    for (int i = 0; i < n; ++i) {
      const NodeUnknowns& unknowns = at(plane, i);
      if (unknowns.first < 0) continue;
      const Eigen::Vector3d value = unknowns.sign.cwiseProduct(x.segment<3>(unknowns.first));
      u.col(plane * n + i) = value;
      if (symmetry_ != RingSymmetry::none && plane > 0 && plane < sectors_) {
        u.col((S - plane) * n + mirror_[i]) = parity * kTurn.cwiseProduct(value);
      }
    }
  }
  return u;
}

Eigen::VectorXd RingUnknowns::compress(const Eigen::Matrix3Xd& u) const {
  const int n = ring_.mesh().nodes_per_sector();
  Eigen::VectorXd x = Eigen::VectorXd::Zero(size_);
  for (int plane = 0; plane < planes_; ++plane) {
    for (int i = 0; i < n; ++i) {
      const NodeUnknowns& unknowns = at(plane, i);
      if (unknowns.first < 0) continue;
      if (!mirror_.empty() && (plane == 0 || plane == sectors_) && mirror_[i] < i) continue;
      x.segment<3>(unknowns.first) = u.col(plane * n + i);
    }
  }
  for (int dof : held_) x[dof] = 0.0;
  return x;
}

}  // namespace latsch::fe_tire
