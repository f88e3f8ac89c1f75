// SPDX-License-Identifier: Apache-2.0
// Numbering of the ring's unknowns, whole or halved by symmetry.
//
// A tire with equal sides does not change when it is turned by 180 degrees about the vertical axis
// through the wheel center. This includes its cords, because the turn keeps their angle, which a
// mirror would not. Flat ground keeps this symmetry. A tire pressed straight down therefore stays
// even under the turn, and its modes are even or odd:
//   u(-x, -y, z) = +- (-u_x, -u_y, u_z).
// Half the ring then holds everything: in sector frames node i of plane s and its image, node
// mirror(i) of plane S - s, share their unknowns up to the signs (-, -, +), all reversed for odd
// states. This is exact and halves the work.
#pragma once

#include <Eigen/Core>
#include <array>
#include <optional>
#include <vector>

#include "models/fe_tire/ring/ring.h"

namespace latsch::fe_tire {

enum class RingSymmetry { none, even, odd };

/// Returns mirror[i], the section node that the half turn brings to i, or nothing if mesh or
/// materials do not have the symmetry.
std::optional<std::vector<int>> find_mirror(const Mesh& mesh, const Materials& materials);

class RingUnknowns {
 public:
  /// `mirror` is used only if there is a symmetry.
  RingUnknowns(const Ring& ring, RingSymmetry symmetry, const std::vector<int>& mirror);

  const Ring& ring() const { return ring_; }
  int size() const { return size_; }
  /// Number of sectors whose elements are assembled, 0 ... sectors()-1: all, or half of them.
  int sectors() const { return sectors_; }
  /// Size of the whole ring over that of the assembled part, 1 or 2.
  double multiplicity() const { return symmetry_ == RingSymmetry::none ? 1.0 : 2.0; }

  /// Returns the unknowns of each element's 24 displacements, -1 if the rim holds them. The element
  /// index is sector-major.
  std::vector<std::vector<int>> connectivity() const;
  struct NodeUnknowns {
    int first = -1;  // first of three consecutive unknowns; -1: held by the rim
    Eigen::Vector3d sign = Eigen::Vector3d::Ones();
  };
  /// Returns the unknowns of a node of the whole ring, planes 0 ... S-1. Its displacement is sign x
  /// unknowns.
  NodeUnknowns of_node(int plane, int section_node) const;
  /// Unknowns that symmetry holds at zero (on the axis of the half turn). They keep a
  /// number.
  const std::vector<int>& held() const { return held_; }

  /// Returns element displacements [3 x 8] in the frame of the element's sector.
  Matrix38 gather(int sector, int element, const Eigen::VectorXd& x) const;
  /// Transforms the stiffness of an element from the frames of its nodes to the order and signs of
  /// the unknowns.
  void bring_in_order(int sector, int element, Matrix24& K) const;

  /// Adds element forces, in the frames of the element's nodes, to a sum over the unknowns.
  void add_forces(int sector,
                  int element,
                  const Vector24& f,
                  Eigen::Ref<Eigen::VectorXd> sum) const;

  /// Convert between unknowns and displacements of all nodes of the ring [3 x nodes], sector
  /// frames.
  Eigen::Matrix3Xd expand(const Eigen::VectorXd& x) const;
  Eigen::VectorXd compress(const Eigen::Matrix3Xd& u) const;

 private:
  const NodeUnknowns& at(int plane, int node) const;
  void number(const std::vector<int>& mirror);

  const Ring& ring_;
  RingSymmetry symmetry_;
  std::vector<int> mirror_;
  int sectors_ = 0, planes_ = 0, size_ = 0;
  std::vector<NodeUnknowns> nodes_;  // plane-major
  std::vector<int> held_;
};

}  // namespace latsch::fe_tire
