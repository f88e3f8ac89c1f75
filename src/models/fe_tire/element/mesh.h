// SPDX-License-Identifier: Apache-2.0
// HEX8 mesh of a tire: one sector and its rotational copies around the spin axis.
//
// Frame: wheel center at the origin, x forward, y along the spin axis (left), z up (ISO 8855).
// Sector s = 0 starts at the bottom, (0, y, -r); plane s is plane 0 turned by theta_s so that it
// lies at (r sin theta, y, -r cos theta). All planes have the same coordinates in their own frames,
// so only one plane is stored. Displacements are kept in these frames too: if sectors are equally
// wide, theta_s = 2 pi s / S, an element looks the same in all of them.
#pragma once

#include <Eigen/Core>
#include <array>
#include <string>
#include <vector>

namespace latsch::fe_tire {

/// A layer of cords inside an element at the parametric thickness position zeta (-1 inner face, +1
/// outer face).
struct RebarPlacement {
  int layer = 0;      // index into Materials::layers
  double zeta = 0.0;  // [-1, 1]
};

/// Transition from many rows to few. An element of the many rows has corners that are not nodes but
/// lie on the line between the two nodes that replace them: the neighbor's edge stays straight and
/// no gap opens. The element's forces and stiffness are assigned to these nodes (hex8_batch.h).
struct EdgeTie {
  int eta = 0;                      // side of the tied corners, -1 or +1; 0: all corners are nodes
  double lower = 0.0, upper = 1.0;  // position of the corners between the lower (0) and the upper
                                    // node (1)
  /// Returns element-local node numbers: lower and upper node of both planes.
  std::array<std::array<int, 2>, 2> pairs() const {
    if (eta < 0) return {{{0, 4}, {1, 5}}};
    return {{{3, 7}, {2, 6}}};
  }
  bool operator==(const EdgeTie&) const = default;
};

/// Local axes: xi around the circumference, eta from the +y bead over the crown to the -y bead,
/// zeta outward. Nodes 0-3 lie on the inner face (zeta = -1), 4-7 on the outer face, both
/// counterclockwise seen from outside (order of CalculiX' C3D8): (-,-) (+,-) (+,+) (-,+) in
/// (xi, eta).
struct Element {
  std::array<int, 8> node;  // numbers from nodes_per_sector on belong to the next sector
  int solid = 0;            // index into Materials::solids
  int region = 0;           // index into Mesh::region_names
  bool inner = false;       // face zeta = -1 carries the inflation pressure
  bool tread = false;       // face zeta = +1 may touch the ground
  /// Number of elements through the thickness of the element's layer; 0: not a layer of a wall.
  /// Composite layers correct their transverse shear by this number, see layer_stiffness.
  int layer_rows = 0;
  /// Thickness of a wall that bends as one, m; 0: none, or a wall with sliding layers. Elements of
  /// such a wall correct their shear along eta by it, see bending_of_shear in hex8_solid_shell.h.
  double wall = 0.0;
  std::vector<RebarPlacement> rebars;
  EdgeTie tie;
};

struct Mesh {
  int sectors = 1;  // S >= 3 rotational copies, or 1: a complete mesh without symmetry
  /// theta_s, rad, of the planes s = 0 ... S - 1, ascending from 0 and the same on both sides of
  /// the contact: theta_(S-s) = 2 pi - theta_s. Empty: all sectors equally wide.
  std::vector<double> theta;
  Eigen::Matrix3Xd X;  // [3 x nodes_per_sector] reference positions in the sector frame, m
  std::vector<Element> elements;  // elements of one sector
  std::vector<int> clamped;       // nodes of one sector held by the rim, ascending
  std::vector<int> sensors;       // nodes on one sector's outer surface, where mode shapes are
                                  // compared
  std::vector<std::string> region_names;

  int nodes_per_sector() const { return static_cast<int>(X.cols()); }
  int nodes() const { return sectors * nodes_per_sector(); }
  int element_count() const { return sectors * static_cast<int>(elements.size()); }
  int free_dofs() const { return 3 * (nodes() - sectors * static_cast<int>(clamped.size())); }

  /// Returns theta of a plane 0 ... S, rad.
  double angle(int plane) const;
  /// Rotation that turns a vector from the next sector's frame into this sector's (identity for S =
  /// 1).
  Eigen::Matrix3d sector_rotation(int sector = 0) const;
  /// Frame of sector s: turns a vector from that frame into the wheel frame.
  Eigen::Matrix3d frame(int sector) const;
  /// Reference coordinates of an element's corners in its sector's frame [3 x 8], m.
  Eigen::Matrix<double, 3, 8> coordinates(const Element& element, int sector = 0) const;
  /// Returns the tire with equally wide sectors.
  Mesh evenly_divided() const;
  /// Largest undeformed radius of a tread node, m.
  double outer_radius() const;
};

/// Corners of elements for programs and pictures that know only nodes. The corners that tied
/// elements have between two nodes are added to the nodes of a plane.
struct Corners {
  struct Tied {
    int lower, upper;  // nodes of the plane
    double at;         // share between the lower (0) and the upper node (1)
    bool operator==(const Tied&) const = default;
  };
  std::vector<Tied> tied;
  /// Corners of every element. Those of its plane count from 0, the tied ones behind the nodes;
  /// those of the next plane follow.
  std::vector<std::array<int, 8>> of_element;
};
Corners corners_of(const Mesh& mesh);

/// Throws InputError naming element and reason if an element is inverted or degenerate, a node
/// unused, or an index out of range.
void check(const Mesh& mesh);

}  // namespace latsch::fe_tire
