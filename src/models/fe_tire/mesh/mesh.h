// SPDX-License-Identifier: Apache-2.0
// Mesh of eight-node hexahedra (HEX8) of a tire: one sector and its rotational copies around the
// spin axis.
//
// Frame: wheel center at the origin, x forward, y along the spin axis (left), z up (ISO 8855).
// Sector s = 0 starts at the bottom, at (0, y, -r). Section plane s is plane 0 rotated by theta_s
// to (r sin theta, y, -r cos theta). All planes have the same coordinates in their own frames, so
// only one plane is stored. Displacements, too, are expressed in these frames. If the sectors are
// equally wide, theta_s = 2 pi s / S, an element has the same coordinates in all of them.
#pragma once

#include <Eigen/Core>
#include <array>
#include <string>
#include <vector>

namespace latsch::fe_tire {

/// A cord layer inside an element, at the parent coordinate zeta through the thickness (-1 inner
/// face, +1 outer face).
struct RebarPlacement {
  int layer = 0;      // index into Materials::layers
  double zeta = 0.0;  // [-1, 1]
};

/// Transition from many rows of elements to few. On this side, corners of an element are not nodes
/// but lie on the line between two nodes. The neighbor's edge stays straight, and no gap opens. The
/// element's forces and stiffness are assigned to these two nodes (hex8_batch.h).
struct EdgeTie {
  int eta = 0;  // side of the tied corners, -1 or +1; 0: all corners are nodes
  // Positions of the corners between the lower (0) and the upper node (1).
  double lower = 0.0, upper = 1.0;
  /// Returns the element's local numbers of the lower and upper node in both planes.
  std::array<std::array<int, 2>, 2> pairs() const {
    if (eta < 0) return {{{0, 4}, {1, 5}}};
    return {{{3, 7}, {2, 6}}};
  }
  bool operator==(const EdgeTie&) const = default;
};

/// An element. Its local axes are xi around the circumference, eta from the +y bead over the crown
/// to the -y bead, and zeta outward. Nodes 0-3 lie on the inner face (zeta = -1), nodes 4-7 on the
/// outer face, both counterclockwise seen from outside (the order of C3D8 in CalculiX): (-,-) (+,-)
/// (+,+) (-,+) in (xi, eta).
struct Element {
  // Node numbers; those from nodes_per_sector on belong to the next sector.
  std::array<int, 8> node;
  int solid = 0;       // index into Materials::solids
  int region = 0;      // index into Mesh::region_names
  bool inner = false;  // true: the inflation pressure acts on the face zeta = -1
  bool tread = false;  // true: the face zeta = +1 may touch the ground
  /// Number of elements through the thickness of the element's layer; 0: the element belongs to no
  /// layer of a wall. The transverse shear stiffness of composite layers is corrected with this
  /// number, see layer_stiffness.
  int layer_rows = 0;
  /// Thickness of a wall that bends as one, m; 0: there is none, or its layers slide. The shear
  /// stiffness along eta of an element in such a wall is corrected with it, see bending_of_shear in
  /// hex8_solid_shell.h.
  double wall = 0.0;
  std::vector<RebarPlacement> rebars;
  EdgeTie tie;
};

struct Mesh {
  int sectors = 1;  // S >= 3: number of rotational copies; 1: a complete mesh without symmetry
  /// Angles theta_s, rad, of the section planes s = 0 ... S - 1, ascending from 0 and symmetric to
  /// the contact: theta_(S-s) = 2 pi - theta_s. Empty: all sectors are equally wide.
  std::vector<double> theta;
  Eigen::Matrix3Xd X;  // [3 x nodes_per_sector], positions without load in the sector frame, m
  std::vector<Element> elements;  // elements of one sector
  std::vector<int> clamped;       // nodes of one sector that the rim holds, ascending
  // Nodes on the outer surface of one sector at which mode shapes are compared.
  std::vector<int> sensors;
  std::vector<std::string> region_names;

  int nodes_per_sector() const { return static_cast<int>(X.cols()); }
  int nodes() const { return sectors * nodes_per_sector(); }
  int element_count() const { return sectors * static_cast<int>(elements.size()); }
  int free_dofs() const { return 3 * (nodes() - sectors * static_cast<int>(clamped.size())); }

  /// Returns the angle theta of a section plane 0 ... S, rad.
  double angle(int plane) const;
  /// Returns the rotation of a vector from the next sector's frame into this sector's frame
  /// (identity for S = 1).
  Eigen::Matrix3d sector_rotation(int sector = 0) const;
  /// Returns the rotation of a vector from the frame of a sector into the wheel frame.
  Eigen::Matrix3d frame(int sector) const;
  /// Returns the coordinates without load of an element's corners in its sector's frame [3 x 8], m.
  Eigen::Matrix<double, 3, 8> coordinates(const Element& element, int sector = 0) const;
  /// Returns the mesh of the same tire with equally wide sectors.
  Mesh evenly_divided() const;
  /// Returns the largest radius of a tread node without load, m.
  double outer_radius() const;
};

/// Corners of elements, for programs and pictures that know no ties. Corners of tied elements,
/// which lie between two nodes, are added to the nodes of a section plane.
struct Corners {
  struct Tied {
    int lower, upper;  // nodes of the section plane
    double at;         // position between the lower (0) and the upper node (1)
    bool operator==(const Tied&) const = default;
  };
  std::vector<Tied> tied;
  /// Corners of every element. The numbers of corners in the element's own plane start at 0, with
  /// tied corners after the nodes; those of the next plane follow.
  std::vector<std::array<int, 8>> of_element;
};
Corners corners_of(const Mesh& mesh);

/// Throws InputError if an element is inverted or degenerate, a node is unused, or an index is out
/// of range. The message names the element and the reason.
void check(const Mesh& mesh);

}  // namespace latsch::fe_tire
