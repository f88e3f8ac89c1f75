// SPDX-License-Identifier: Apache-2.0
// A road of triangles, seen from above. The height is that of the plane of the triangle below a
// point, and of the highest if there are several. Vertical triangles are walls and contain no
// point.
//
// Beside the mesh, and in its holes, the road is level at the height of the mesh's nearest point in
// plan. Triangles are found through a grid of cells in the plane, with about one cell per triangle.
#pragma once

#include <algorithm>
#include <array>
#include <cmath>
#include <vector>

#include "models/road/road.h"

namespace latsch::road {

/// Triangles with their nodes.
struct TriangleMesh {
  /// Three nodes, and the friction between them.
  struct Triangle {
    std::array<int, 3> nodes = {};  // indices of nodes
    double friction = 1.0;          // factor on the tire's own friction
  };
  std::vector<Eigen::Vector3d> nodes;  // m
  std::vector<Triangle> triangles;     // in any order
};

class TriangleRoad final : public Road {
 public:
  /// The mesh must have at least one triangle that is not vertical.
  explicit TriangleRoad(TriangleMesh mesh);

  GroundPoint at(double x, double y, double time) const override;
  double height(double x, double y, double time) const override;
  /// Reports points beside the mesh and in its holes.
  std::string beyond(double x, double y) const override;
  double mean_height(const Eigen::Vector2d& from,
                     const Eigen::Vector2d& to,
                     double time) const override;
  /// Exact to the cells of the grid. If these are not covered, the highest of all nodes is
  /// returned.
  GroundBounds bounds(const GroundBox& box, double time) const override;

  /// True if the triangle is seen from above.
  static bool has_area(const TriangleMesh& mesh, const TriangleMesh::Triangle& triangle);

  /// The mesh it was made from.
  const TriangleMesh& mesh() const { return mesh_; }
  /// Bounds of all nodes, in plan.
  Eigen::Vector2d low() const { return low_; }
  /// The greatest x and y of all nodes, m.
  Eigen::Vector2d high() const { return high_; }

 private:
  /// A triangle in plan, counterclockwise, and its plane.
  struct Facet {
    std::array<Eigen::Vector2d, 3> corners;
    Eigen::Vector2d slope;  // dz/dx, dz/dy
    double z0 = 0.0;        // height at corners[0]
    double friction = 1.0;

    double z(const Eigen::Vector2d& p) const { return z0 + slope.dot(p - corners[0]); }
    /// True if both have the same plane and friction.
    bool continues(const Facet& other) const {
      return slope == other.slope && friction == other.friction &&
             std::abs(other.z(corners[0]) - z0) <= 1e-12;
    }
    double highest() const { return std::max({z(corners[0]), z(corners[1]), z(corners[2])}); }
    bool covers(const Eigen::Vector2d& p) const;
    double end_of(const Eigen::Vector2d& from, const Eigen::Vector2d& way) const;
    Eigen::Vector2d nearest(const Eigen::Vector2d& p) const;
  };
  struct Hit {
    int facet = -1;
    double z = 0.0;
    bool inside = false;
  };

  void build_facets();
  double shape_of_facets() const;
  bool is_covered(const GroundBox& box) const;
  void build_grid();
  void find_covered();
  std::array<int, 2> cell_of(const Eigen::Vector2d& p) const;
  Hit find_covering(const Eigen::Vector2d& p) const;
  Hit find(const Eigen::Vector2d& p) const;
  Hit find_nearest(const Eigen::Vector2d& p) const;
  template <class Action>
  void in_cell(int column, int row, const Action& action) const;

  TriangleMesh mesh_;
  std::vector<Facet> facets_;
  Eigen::Vector2d low_, high_, size_;  // bounds of all; size of a cell
  int columns_ = 1, rows_ = 1;
  std::vector<int> begins_;   // start of each cell in members_
  std::vector<int> members_;  // facets
  /// Contents of a cell of the grid.
  struct Cell {
    double highest;
    int facet;     // its first facet; none: -1
    bool plane;    // all facets are in that plane
    bool covered;  // the cell has no hole
  };
  std::vector<Cell> cells_;
  double highest_ = 0.0;  // m, of all facets
};

}  // namespace latsch::road
