// SPDX-License-Identifier: Apache-2.0
// The whole ring: element shapes of its sectors, unknowns of one of them, and the frames between
// them.
//
// Unknowns are the displacements of the nodes the rim does not hold, in sector frames, ordered
// sector, section node, direction. An element sees its own sector's frame: the displacements of the
// next sector's nodes are turned into it, and the forces on them turned back. Sectors of the same
// width thus share the same 8-node shapes. Where all are equally wide and the state is the same in
// every sector, so is every element matrix: the tangent is block-circulant.
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
  /// Sectors of the same number, 0 ... widths()-1, are equally wide.
  int width(int sector) const { return width_[sector]; }
  int widths() const { return static_cast<int>(shapes_.size()); }
  int sectors() const { return mesh_.sectors; }
  int elements_per_sector() const { return static_cast<int>(mesh_.elements.size()); }
  int alphas_per_element() const { return alphas_; }
  /// Whether the pressurized surface ends at the edge from node k to node k + 1 (mod 4) of an
  /// element's inner face, and the rim does not hold it there.
  bool is_edge_open(int element, int k) const { return open_edges_[element][k]; }
  /// Where an element is, for messages; elements count sector by sector: "element 61 (sector 2,
  /// section element 2, belt)".
  std::string place(int element) const;

  /// Unknowns of one sector.
  int sector_unknowns() const { return 3 * free_nodes_; }

  /// First unknown of a section node in its sector, -1 where the rim holds it.
  int sector_dof(int section_node) const { return first_dof_[section_node]; }
  /// The 24 unknowns of an element of sector 0, counting through sectors 0 and 1; -1: held.
  const std::array<int, 24>& local_dofs(int element) const { return local_dofs_[element]; }
  /// Turns a vector of the next sector's frame into this sector's frame: about the spin axis.
  const Eigen::Matrix3d& rotation(int sector) const { return Q_[width_[sector]]; }
  /// Displacements given in node frames turned into the element's (its sector's) frame.
  Matrix38 in_element_frame(int sector, int element, Matrix38 u) const;
  /// Element displacements [3 x 8] of a state equal in all sectors, x of one sector; these are
  /// equally wide.
  Matrix38 gather_axisymmetric(int element, const Eigen::VectorXd& x) const;
  /// Turns forces (and stiffness) of the next sector's nodes from the element's frame into their
  /// own.
  void turn_to_node_frames(int sector, int element, Vector24& f, Matrix24* K) const;

  /// Displacements of a sector's nodes [3 x nodes_per_sector], zeros where held; and back.
  Eigen::Matrix3Xd expand(const Eigen::VectorXd& x) const;
  Eigen::VectorXd compress(const Eigen::Matrix3Xd& u) const;

 private:
  Mesh mesh_;
  std::vector<int> width_;          // of every sector
  std::vector<Eigen::Matrix3d> Q_;  // of every width: next sector's frame -> own frame
  int alphas_ = 0;
  int free_nodes_ = 0;
  std::vector<int> first_dof_;
  std::vector<std::vector<HexShape>> shapes_;  // of every width
  std::vector<std::array<int, 24>> local_dofs_;
  std::vector<std::array<bool, 4>> open_edges_;
};

}  // namespace latsch::fe_tire
