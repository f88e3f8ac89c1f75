// SPDX-License-Identifier: Apache-2.0
// Numbering of the ring's unknowns, whole or halved by symmetry.
//
// A tire with equal sides does not change if it is rotated by 180 degrees ("half turn") about the
// vertical axis through the wheel center. This includes its cords: the rotation keeps their angle,
// unlike a mirror reflection. Flat ground keeps this symmetry. A tire pressed straight down
// therefore stays even under the turn, and its modes are even or odd:
//   u(-x, -y, z) = +- (-u_x, -u_y, u_z).
// Half of the ring then represents all of it: in sector frames node i of plane s and its image,
// node mirror(i) of plane S - s, share their unknowns up to the signs (-, -, +), all reversed for
// odd states. This is exact and halves the work.
#pragma once

#include <Eigen/Core>
#include <array>
#include <optional>
#include <vector>

#include "models/fe_tire/ring/ring.h"

namespace latsch::fe_tire {

enum class RingSymmetry { none, even, odd };

/// Returns mirror[i], the section node to which the half turn moves node i, or nothing if mesh or
/// materials are not symmetric under it.
std::optional<std::vector<int>> find_mirror(const Mesh& mesh, const Materials& materials);

class RingUnknowns {
 public:
  /// Numbers the unknowns. `mirror` is used only if there is a symmetry.
  RingUnknowns(const Ring& ring, RingSymmetry symmetry, const std::vector<int>& mirror);

  const Ring& ring() const { return ring_; }
  int size() const { return size_; }
  /// Returns the number of sectors whose elements are assembled: all sectors, or half of them.
  int sectors() const { return sectors_; }
  /// Returns the size of the whole ring divided by that of the assembled part, 1 or 2.
  double multiplicity() const { return symmetry_ == RingSymmetry::none ? 1.0 : 2.0; }

  /// Returns the unknowns of the 24 displacements of each element; -1: the rim holds the node.
  /// Elements are counted sector by sector.
  std::vector<std::vector<int>> connectivity() const;
  struct NodeUnknowns {
    int first = -1;  // first of three consecutive unknowns; -1: the rim holds the node
    Eigen::Vector3d sign = Eigen::Vector3d::Ones();
  };
  /// Returns the unknowns of a node of the whole ring, in section planes 0 ... S-1. Its
  /// displacement is the sign times the unknowns.
  NodeUnknowns of_node(int plane, int section_node) const;
  /// Unknowns on the axis of the half turn that symmetry holds at zero. They remain in the
  /// numbering.
  const std::vector<int>& held() const { return held_; }

  /// Returns the displacements [3 x 8] of an element in the frame of its sector.
  Matrix38 gather(int sector, int element, const Eigen::VectorXd& x) const;
  /// Transforms the stiffness of an element from the frames of its nodes to the order and the signs
  /// of the unknowns.
  void bring_in_order(int sector, int element, Matrix24& K) const;

  /// Adds the forces on an element's nodes, in the frames of these nodes, to the forces on the
  /// unknowns.
  void add_forces(int sector,
                  int element,
                  const Vector24& f,
                  Eigen::Ref<Eigen::VectorXd> sum) const;

  /// Convert between the unknowns and the displacements of all nodes of the ring [3 x nodes] in
  /// sector frames.
  Eigen::Matrix3Xd expand(const Eigen::VectorXd& x) const;
  Eigen::VectorXd compress(const Eigen::Matrix3Xd& u) const;

 private:
  const NodeUnknowns& at(int plane, int node) const;
  void number(const std::vector<int>& mirror);

  const Ring& ring_;
  RingSymmetry symmetry_;
  std::vector<int> mirror_;
  int sectors_ = 0, planes_ = 0, size_ = 0;
  std::vector<NodeUnknowns> nodes_;  // unknowns of the nodes, section plane by section plane
  std::vector<int> held_;
};

}  // namespace latsch::fe_tire
