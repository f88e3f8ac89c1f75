// SPDX-License-Identifier: Apache-2.0
// Where the tread may touch flat ground: its nodes near the lowest place, by their heights.
//
// Without friction the ground acts along the vertical alone and knows of the tire nothing but the
// heights z_a of these nodes. At a Gauss point of a face, z = sum N_a z_a, and with (C.1) of
// contact.h
//   c_a = -N_a p dA,   p = epsilon (h - z) where z < h, else 0                               (W.1)
// is linear as long as no point comes down or lifts off. Faces farther away are no part of it; what
// touches there is in the tangent like everything else.
#pragma once

#include <Eigen/Core>
#include <vector>

#include "models/fe_tire/ring/contact.h"
#include "models/fe_tire/ring/ring_unknowns.h"

namespace latsch::fe_tire {

class ContactWindow {
 public:
  /// Empty where one sector is the whole mesh or the rim holds nodes of the tread.
  explicit ContactWindow(const RingUnknowns& unknowns);

  bool empty() const { return nodes_.empty(); }
  int nodes() const { return static_cast<int>(nodes_.size()); }
  /// Whether the tread faces of a sector are in it.
  bool holds(int sector) const { return holds_[sector]; }
  /// Of every node: its three unknowns are 3 block_row, ...
  const std::vector<int>& block_rows() const { return block_rows_; }
  /// The vertical in the frame of a node's unknowns.
  const Eigen::Vector3d& up(int node) const { return nodes_[node].up; }

  /// Heights of the nodes over the wheel center in state x, m.
  Eigen::VectorXd heights(const Eigen::VectorXd& x) const;
  /// c (W.1) at these heights, N, and dc/dz, N/m, where given; height and stiffness of the ground
  /// are those of `contact`.
  Eigen::VectorXd forces(const GroundContact& contact,
                         const Eigen::VectorXd& heights,
                         Eigen::MatrixXd* stiffness) const;

 private:
  struct Node {
    Eigen::Vector3d up;
    double height;  // undeformed
  };
  struct Face {
    int sector, index;  // of GroundContact::faces(sector)
    std::array<int, 4> node;
  };
  void clear();
  int node_of(int sector, int element, int corner);

  const RingUnknowns& unknowns_;
  std::vector<bool> holds_;
  std::vector<Node> nodes_;
  std::vector<int> block_rows_;
  std::vector<Face> faces_;
};

}  // namespace latsch::fe_tire
