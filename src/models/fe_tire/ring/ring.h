// SPDX-License-Identifier: Apache-2.0
// The whole ring: element shapes of its sectors, unknowns of one sector, and the frames between
// sectors.
//
// Unknowns are the displacements, in sector frames, of the nodes that the rim does not hold,
// ordered by sector, section node, direction. An element works in its own sector's frame:
// displacements of the next sector's nodes are turned into this frame, and the forces on them
// turned back. Sectors of the same width thus share the same 8-node shapes. If all are equally wide
// and the state is the same in every sector, so is every element matrix, and the tangent is
// block-circulant.
#pragma once

#include <Eigen/Core>
#include <string>
#include <vector>

#include "models/fe_tire/element/hex8.h"
#include "models/fe_tire/element/hex8_shape.h"
#include "models/fe_tire/element/mesh.h"

namespace latsch::fe_tire {

class Ring {
 public:
  Ring(Mesh mesh, ElementKind kind);

  const Mesh& mesh() const { return mesh_; }
  const HexShape& shape(int sector, int element) const { return shapes_[width_[sector]][element]; }
  /// Index of the sector's width, 0 ... widths()-1. Sectors with the same index are equally wide.
  int width(int sector) const { return width_[sector]; }
  int widths() const { return static_cast<int>(shapes_.size()); }
  int sectors() const { return mesh_.sectors; }
  int elements_per_sector() const { return static_cast<int>(mesh_.elements.size()); }
  int alphas_per_element() const { return alphas_; }
  /// True if the pressurized surface ends at the edge from node k to node k + 1 (mod 4) of an
  /// element's inner face and the rim does not hold that edge.
  bool is_edge_open(int element, int k) const { return open_edges_[element][k]; }
  /// Describes an element for messages; elements count sector by sector: "element 61 (sector 2,
  /// section element 2, belt)".
  std::string place(int element) const;

  /// Number of unknowns of one sector.
  int sector_unknowns() const { return 3 * free_nodes_; }

  /// First unknown of a section node in its sector, -1 if the rim holds the node.
  int sector_dof(int section_node) const { return first_dof_[section_node]; }
  /// The 24 unknowns of an element of sector 0, counted through sectors 0 and 1; -1: held by the
  /// rim.
  const std::array<int, 24>& local_dofs(int element) const { return local_dofs_[element]; }
  /// Rotation about the spin axis that turns a vector from the next sector's frame into this
  /// sector's.
  const Eigen::Matrix3d& rotation(int sector) const { return Q_[width_[sector]]; }
  /// Turns displacements from node frames into the frame of the element's sector.
  Matrix38 in_element_frame(int sector, int element, Matrix38 u) const;
  /// Returns element displacements [3 x 8] of a state that is equal in all sectors, with x of one
  /// sector. All sectors must be equally wide.
  Matrix38 gather_axisymmetric(int element, const Eigen::VectorXd& x) const;
  /// Turns forces (and stiffness) of the next sector's nodes from the element's frame into the
  /// frames of these nodes.
  void turn_to_node_frames(int sector, int element, Vector24& f, Matrix24* K) const;

  /// Convert between unknowns and displacements of a sector's nodes [3 x nodes_per_sector], zero
  /// where held.
  Eigen::Matrix3Xd expand(const Eigen::VectorXd& x) const;
  Eigen::VectorXd compress(const Eigen::Matrix3Xd& u) const;

 private:
  Mesh mesh_;
  std::vector<int> width_;          // index of every sector's width
  std::vector<Eigen::Matrix3d> Q_;  // for every width: next sector's frame -> own frame
  int alphas_ = 0;
  int free_nodes_ = 0;
  std::vector<int> first_dof_;
  std::vector<std::vector<HexShape>> shapes_;  // for every width
  std::vector<std::array<int, 24>> local_dofs_;
  std::vector<std::array<bool, 4>> open_edges_;
};

}  // namespace latsch::fe_tire
