// SPDX-License-Identifier: Apache-2.0
// The whole ring: element shapes of its sectors, unknowns of one sector, and the frames between
// sectors.
//
// Unknowns are the displacements, in sector frames, of the nodes that the rim does not hold,
// ordered by sector, section node, direction. An element works in its own sector's frame:
// displacements of the next sector's nodes are rotated into this frame, and the forces on these
// nodes are rotated back. Sectors of the same width thus share the same 8-node shapes. If all are
// equally wide and the state is the same in every sector, so is every element matrix, and the
// tangent is block-circulant.
#pragma once

#include <Eigen/Core>
#include <string>
#include <vector>

#include "models/fe_tire/element/hex8.h"
#include "models/fe_tire/element/hex8_shape.h"
#include "models/fe_tire/mesh/mesh.h"

namespace latsch::fe_tire {

class Ring {
 public:
  Ring(Mesh mesh, ElementKind kind);

  const Mesh& mesh() const { return mesh_; }
  const HexShape& shape(int sector, int element) const { return shapes_[width_[sector]][element]; }
  /// Returns the index of a sector's width, 0 ... widths()-1. Sectors with the same index are
  /// equally wide.
  int width(int sector) const { return width_[sector]; }
  int widths() const { return static_cast<int>(shapes_.size()); }
  int sectors() const { return mesh_.sectors; }
  int elements_per_sector() const { return static_cast<int>(mesh_.elements.size()); }
  int alphas_per_element() const { return alphas_; }
  /// Returns true if the pressurized surface ends at the edge from node k to node k + 1 (mod 4) of
  /// an element's inner face, and the rim does not hold this edge.
  bool is_edge_open(int element, int k) const { return open_edges_[element][k]; }
  /// Describes an element in messages, for example "element 61 (sector 2, section element 2,
  /// belt)". Elements are counted sector by sector.
  std::string place(int element) const;

  /// Number of unknowns of one sector.
  int sector_unknowns() const { return 3 * free_nodes_; }

  /// Returns the first unknown of a section node within its sector, or -1 if the rim holds the
  /// node.
  int sector_dof(int section_node) const { return first_dof_[section_node]; }
  /// Returns the 24 unknowns of an element of sector 0, numbered through sectors 0 and 1; -1: the
  /// rim holds the node.
  const std::array<int, 24>& local_dofs(int element) const { return local_dofs_[element]; }
  /// Returns the rotation about the spin axis from the next sector's frame into this sector's
  /// frame.
  const Eigen::Matrix3d& rotation(int sector) const { return Q_[width_[sector]]; }
  /// Rotates displacements from the frames of the nodes into the frame of the element's sector.
  Matrix38 in_element_frame(int sector, int element, Matrix38 u) const;
  /// Returns the displacements [3 x 8] of an element in a state that is the same in all sectors; x
  /// holds the unknowns of one sector. All sectors must be equally wide.
  Matrix38 gather_axisymmetric(int element, const Eigen::VectorXd& x) const;
  /// Rotates the forces (and the stiffness) of the next sector's nodes from the element's frame
  /// into the frames of these nodes.
  void turn_to_node_frames(int sector, int element, Vector24& f, Matrix24* K) const;

  /// Convert between the unknowns and the displacements of a sector's nodes [3 x nodes_per_sector];
  /// displacements are zero where the rim holds a node.
  Eigen::Matrix3Xd expand(const Eigen::VectorXd& x) const;
  Eigen::VectorXd compress(const Eigen::Matrix3Xd& u) const;

 private:
  Mesh mesh_;
  std::vector<int> width_;  // index of the width of every sector
  // For every width: rotation from the next sector's frame into the own frame.
  std::vector<Eigen::Matrix3d> Q_;
  int alphas_ = 0;
  int free_nodes_ = 0;
  std::vector<int> first_dof_;
  std::vector<std::vector<HexShape>> shapes_;  // element shapes of one sector, for every width
  std::vector<std::array<int, 24>> local_dofs_;
  std::vector<std::array<bool, 4>> open_edges_;
};

}  // namespace latsch::fe_tire
