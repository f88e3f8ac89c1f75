// SPDX-License-Identifier: Apache-2.0
// A road that consists of triangles. The height at a position is that of the triangle that covers
// it in plan view; if there are several, it is that of the highest. Vertical triangles are walls
// and contain no point.
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

/// A triangle mesh: nodes and triangles.
struct TriangleMesh {
  /// A triangle: the indices of its nodes, and its friction.
  struct Triangle {
    std::array<int, 3> nodes = {};  // indices of nodes
    double friction = 1.0;          // factor by which the tire's own friction is multiplied
  };
  std::vector<Eigen::Vector3d> nodes;  // m
  std::vector<Triangle> triangles;     // in any order
};

class TriangleRoad final : public Road {
 public:
  /// Makes the road. The mesh must have at least one triangle that is not vertical.
  explicit TriangleRoad(TriangleMesh mesh);

  GroundPoint at(double x, double y, double time) const override;
  double height(double x, double y, double time) const override;
  /// Returns the reason why a point is off the road: it lies beside the mesh or in a hole of it.
  /// Returns an empty text for points of the road.
  std::string beyond(double x, double y) const override;
  double mean_height(const Eigen::Vector2d& from,
                     const Eigen::Vector2d& to,
                     double time) const override;
  /// Returns the highest point of the grid cells that the box touches. If these cells have holes,
  /// returns the highest of all nodes.
  GroundBounds bounds(const GroundBox& box, double time) const override;

  /// Returns true if the triangle is not vertical, so that it has an area in plan view.
  static bool has_area(const TriangleMesh& mesh, const TriangleMesh::Triangle& triangle);

  /// The mesh from which this road was made.
  const TriangleMesh& mesh() const { return mesh_; }
  /// Returns the smallest x and y of all nodes, m.
  Eigen::Vector2d low() const { return low_; }
  /// Returns the largest x and y of all nodes, m.
  Eigen::Vector2d high() const { return high_; }

 private:
  /// A triangle in plan view, with counterclockwise corners, and the plane in which it lies.
  struct Facet {
    std::array<Eigen::Vector2d, 3> corners;
    Eigen::Vector2d slope;  // dz/dx, dz/dy
    double z0 = 0.0;        // m, height at corners[0]
    double friction = 1.0;

    double z(const Eigen::Vector2d& p) const { return z0 + slope.dot(p - corners[0]); }
    /// Returns true if both triangles lie in the same plane and have the same friction.
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
  Eigen::Vector2d low_, high_, size_;  // m, corners of the grid in plan view; size of a cell
  int columns_ = 1, rows_ = 1;
  std::vector<int> begins_;   // index in members_ at which the list of each cell begins
  std::vector<int> members_;  // facets
  /// Summary of the triangles in a cell of the grid.
  struct Cell {
    double highest;
    int facet;     // first facet of the cell; -1: none
    bool plane;    // true: all facets of the cell lie in one plane
    bool covered;  // true: the facets fill the cell without a hole
  };
  std::vector<Cell> cells_;
  double highest_ = 0.0;  // m, greatest height of all facets
};

}  // namespace latsch::road
