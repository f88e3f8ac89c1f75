// SPDX-License-Identifier: Apache-2.0
// A road of triangles, seen from above: height by plane interpolation in the triangle below a
// point, the highest one where several are; vertical ones are walls and have no point.
//
// Beside the mesh, and in holes of it, the road keeps the height of the nearest point of the mesh
// in plan and is level. Triangles are found through a grid of cells in the plane, about one for
// each of them.
#pragma once

#include <algorithm>
#include <array>
#include <cmath>
#include <vector>

#include "models/road/road.h"

namespace latsch::road {

struct TriangleMesh {
  struct Triangle {
    std::array<int, 3> nodes = {};
    double friction = 1.0;
  };
  std::vector<Eigen::Vector3d> nodes;  // m
  std::vector<Triangle> triangles;
};

class TriangleRoad final : public Road {
 public:
  /// At least one triangle that is not vertical.
  explicit TriangleRoad(TriangleMesh mesh);

  GroundPoint at(double x, double y, double time) const override;
  double height(double x, double y, double time) const override;
  /// Beside the mesh and in its holes.
  std::string beyond(double x, double y) const override;
  double mean_height(const Eigen::Vector2d& from,
                     const Eigen::Vector2d& to,
                     double time) const override;
  /// Exact to the cells of the grid; where those are not covered the highest of all nodes.
  GroundBounds bounds(const GroundBox& box, double time) const override;

  /// Whether it is seen from above.
  static bool has_area(const TriangleMesh& mesh, const TriangleMesh::Triangle& triangle);

  const TriangleMesh& mesh() const { return mesh_; }
  /// Of all nodes, in plan.
  Eigen::Vector2d low() const { return low_; }
  Eigen::Vector2d high() const { return high_; }

 private:
  /// A triangle in plan, counterclockwise, and its plane.
  struct Facet {
    std::array<Eigen::Vector2d, 3> corners;
    Eigen::Vector2d slope;  // dz/dx, dz/dy
    double z0 = 0.0;        // at corners[0]
    double friction = 1.0;

    double z(const Eigen::Vector2d& p) const { return z0 + slope.dot(p - corners[0]); }
    /// Whether both are one plane of one friction.
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
  Eigen::Vector2d low_, high_, size_;  // of all, of a cell
  int columns_ = 1, rows_ = 1;
  std::vector<int> begins_;   // of each cell in members_
  std::vector<int> members_;  // facets
  /// What is in a cell of the grid.
  struct Cell {
    double highest;
    int facet;     // its first; none: -1
    bool plane;    // all are in the plane of that
    bool covered;  // it has no hole
  };
  std::vector<Cell> cells_;
  double highest_ = 0.0;  // m, of all facets
};

}  // namespace latsch::road
