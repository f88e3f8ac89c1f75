// SPDX-License-Identifier: Apache-2.0
#include "models/road/triangle_road.h"

#include <fmt/format.h>

#include <Eigen/Geometry>
#include <algorithm>
#include <cassert>
#include <cmath>
#include <limits>
#include <vector>

namespace latsch::road {
namespace {

using Eigen::Vector2d;
using Eigen::Vector3d;

// Area of a triangle in plan view, relative to its longest edge squared. A triangle with a smaller
// area counts as vertical.
constexpr double kWall = 1e-12;
// Tolerance for points on an edge, relative to the area of the triangle. Because of it no point on
// a common edge falls between both neighbors.
constexpr double kOnEdge = 1e-12;
// Largest mean number of grid cells per triangle. Long triangles lie in many cells, so the grid is
// made coarser until the number is not exceeded. A larger limit costs memory, a smaller one makes
// searches slower.
constexpr double kEntries = 16.0;
constexpr double kMostCells = 4e6;

double cross(const Vector2d& a, const Vector2d& b) { return a.x() * b.y() - a.y() * b.x(); }

}  // namespace

bool TriangleRoad::Facet::covers(const Vector2d& p) const {
  const Vector2d &a = corners[0], &b = corners[1], &c = corners[2];
  const double least = -kOnEdge * cross(b - a, c - a);
  return cross(b - a, p - a) >= least && cross(c - b, p - b) >= least &&
         cross(a - c, p - c) >= least;
}

/// Returns the position along the line, as a share of `way`, at which the line leaves the triangle.
/// The line starts inside the triangle or enters it later.
double TriangleRoad::Facet::end_of(const Vector2d& from, const Vector2d& way) const {
  double end = std::numeric_limits<double>::infinity();
  for (int i = 0; i < 3; ++i) {
    const Vector2d &a = corners[i], edge = corners[(i + 1) % 3] - a;
    const double leaves = -cross(edge, way);
    if (leaves > 0.0) end = std::min(end, cross(edge, from - a) / leaves);
  }
  return end;
}

Vector2d TriangleRoad::Facet::nearest(const Vector2d& p) const {
  if (covers(p)) return p;
  Vector2d best = corners[0];
  for (int i = 0; i < 3; ++i) {
    const Vector2d &a = corners[i], edge = corners[(i + 1) % 3] - a;
    const double part = std::clamp(edge.dot(p - a) / edge.squaredNorm(), 0.0, 1.0);
    const Vector2d foot = a + part * edge;
    if ((foot - p).squaredNorm() < (best - p).squaredNorm()) best = foot;
  }
  return best;
}

TriangleRoad::TriangleRoad(TriangleMesh mesh) : mesh_(std::move(mesh)) {
  build_facets();
  assert(!facets_.empty());
  build_grid();
  find_covered();
}

bool TriangleRoad::has_area(const TriangleMesh& mesh, const TriangleMesh::Triangle& triangle) {
  const Vector2d a = mesh.nodes[triangle.nodes[0]].head<2>();
  const Vector2d b = mesh.nodes[triangle.nodes[1]].head<2>();
  const Vector2d c = mesh.nodes[triangle.nodes[2]].head<2>();
  const double longest =
      std::max({(b - a).squaredNorm(), (c - b).squaredNorm(), (a - c).squaredNorm()});
  return std::abs(cross(b - a, c - a)) > kWall * longest;
}

void TriangleRoad::build_facets() {
  for (const TriangleMesh::Triangle& triangle : mesh_.triangles) {
    if (!has_area(mesh_, triangle)) continue;
    std::array<Vector3d, 3> p;
    for (int i = 0; i < 3; ++i) p[i] = mesh_.nodes[triangle.nodes[i]];
    Vector3d normal = (p[1] - p[0]).cross(p[2] - p[0]);
    if (normal.z() < 0.0) {
      std::swap(p[1], p[2]);
      normal = -normal;
    }
    Facet facet;
    for (int i = 0; i < 3; ++i) facet.corners[i] = p[i].head<2>();
    facet.slope = -normal.head<2>() / normal.z();
    facet.z0 = p[0].z();
    facet.friction = triangle.friction;
    facets_.push_back(facet);
  }
}

/// Returns the extent along x over the extent along y of a typical triangle. It is the geometric
/// mean of all triangles, on which a few long ones have little influence.
double TriangleRoad::shape_of_facets() const {
  constexpr double kThinnest = 1e-9;  // m
  double sum = 0.0;
  for (const Facet& facet : facets_) {
    const auto& [a, b, c] = facet.corners;
    const Vector2d size =
        (a.cwiseMax(b).cwiseMax(c) - a.cwiseMin(b).cwiseMin(c)).cwiseMax(kThinnest);
    sum += std::log(size.x() / size.y());
  }
  return std::exp(sum / static_cast<double>(facets_.size()));
}

void TriangleRoad::build_grid() {
  low_ = high_ = facets_.front().corners[0];
  for (const Facet& facet : facets_) {
    for (const Vector2d& corner : facet.corners) {
      low_ = low_.cwiseMin(corner);
      high_ = high_.cwiseMax(corner);
    }
  }
  const Vector2d extent = (high_ - low_).cwiseMax(1e-9);
  double cell = std::sqrt(extent.prod() / static_cast<double>(facets_.size()));
  const double stretch = std::sqrt(shape_of_facets());
  for (;; cell *= 2.0) {
    columns_ = static_cast<int>(std::clamp(extent.x() / (cell * stretch), 1.0, kMostCells));
    rows_ = static_cast<int>(std::clamp(extent.y() / cell * stretch, 1.0, kMostCells));
    if (double(columns_) * rows_ > kMostCells) continue;
    size_ = {extent.x() / columns_, extent.y() / rows_};
    double entries = 0.0;
    for (const Facet& facet : facets_) {
      const auto [from, to] = std::minmax({cell_of(facet.corners[0])[0],
                                           cell_of(facet.corners[1])[0],
                                           cell_of(facet.corners[2])[0]});
      const auto [down, up] = std::minmax({cell_of(facet.corners[0])[1],
                                           cell_of(facet.corners[1])[1],
                                           cell_of(facet.corners[2])[1]});
      entries += (to - from + 1.0) * (up - down + 1.0);
    }
    if (entries <= kEntries * static_cast<double>(facets_.size())) break;
    if (columns_ == 1 && rows_ == 1) break;
  }
  begins_.assign(columns_ * rows_ + 1, 0);
  const auto each_cell = [&](const auto& action) {
    for (int i = 0; i < std::ssize(facets_); ++i) {
      const auto& corners = facets_[i].corners;
      const auto a = cell_of(corners[0].cwiseMin(corners[1]).cwiseMin(corners[2]));
      const auto b = cell_of(corners[0].cwiseMax(corners[1]).cwiseMax(corners[2]));
      for (int row = a[1]; row <= b[1]; ++row)
        for (int column = a[0]; column <= b[0]; ++column) action(row * columns_ + column, i);
    }
  };
  each_cell([&](int cell_number, int) { ++begins_[cell_number + 1]; });
  for (std::size_t i = 1; i < begins_.size(); ++i) begins_[i] += begins_[i - 1];
  members_.resize(begins_.back());
  std::vector<int> next(begins_.begin(), begins_.end() - 1);
  each_cell([&](int cell_number, int facet) { members_[next[cell_number]++] = facet; });
}

template <class Action>
void TriangleRoad::in_cell(int column, int row, const Action& action) const {
  const int cell = row * columns_ + column;
  for (int i = begins_[cell]; i < begins_[cell + 1]; ++i) action(members_[i]);
}

namespace {

/// Returns the area of the part of a triangle that is inside a rectangle, by clipping the triangle
/// at each side of the rectangle.
double area_within(const std::array<Vector2d, 3>& corners,
                   const Vector2d& low,
                   const Vector2d& high) {
  std::vector<Vector2d> polygon(corners.begin(), corners.end());
  for (int side = 0; side < 4 && !polygon.empty(); ++side) {
    const int axis = side / 2;
    const double sign = side % 2 == 0 ? 1.0 : -1.0, at = side % 2 == 0 ? low[axis] : high[axis];
    std::vector<Vector2d> kept;
    for (std::size_t i = 0; i < polygon.size(); ++i) {
      const Vector2d &a = polygon[i], &b = polygon[(i + 1) % polygon.size()];
      const double da = sign * (a[axis] - at), db = sign * (b[axis] - at);
      if (da >= 0.0) kept.push_back(a);
      if ((da > 0.0 && db < 0.0) || (da < 0.0 && db > 0.0))
        kept.push_back(a + da / (da - db) * (b - a));
    }
    polygon = std::move(kept);
  }
  double twice = 0.0;
  for (std::size_t i = 1; i + 1 < polygon.size(); ++i)
    twice += cross(polygon[i] - polygon[0], polygon[i + 1] - polygon[0]);
  return 0.5 * twice;
}

}  // namespace

/// Finds the grid cells without holes. The triangles of a mesh without overlaps fill the area of
/// such a cell. If triangles overlap, their areas add up to more, and the cell counts as one with
/// holes.
void TriangleRoad::find_covered() {
  constexpr double kRounding = 1e-9;
  highest_ = facets_.front().highest();
  for (const Facet& facet : facets_) highest_ = std::max(highest_, facet.highest());
  cells_.clear();
  for (int row = 0; row < rows_; ++row) {
    for (int column = 0; column < columns_; ++column) {
      const Vector2d corner = low_ + Vector2d(column * size_.x(), row * size_.y());
      Cell cell{-std::numeric_limits<double>::infinity(), -1, true, false};
      double area = 0.0;
      in_cell(column, row, [&](int number) {
        const Facet& facet = facets_[number];
        area += area_within(facet.corners, corner, corner + size_);
        if (cell.facet < 0) cell.facet = number;
        cell.highest = std::max(cell.highest, facet.highest());
        cell.plane = cell.plane && facet.continues(facets_[cell.facet]);
      });
      cell.covered = std::abs(area / size_.prod() - 1.0) < kRounding;
      cells_.push_back(cell);
    }
  }
}

bool TriangleRoad::is_covered(const GroundBox& box) const {
  if (!(box.x0 >= low_.x() && box.y0 >= low_.y() && box.x1 <= high_.x() && box.y1 <= high_.y()))
    return false;
  const auto from = cell_of({box.x0, box.y0}), to = cell_of({box.x1, box.y1});
  for (int row = from[1]; row <= to[1]; ++row)
    for (int column = from[0]; column <= to[0]; ++column)
      if (!cells_[row * columns_ + column].covered) return false;
  return true;
}

GroundBounds TriangleRoad::bounds(const GroundBox& box, double) const {
  const bool inside =
      box.x0 >= low_.x() && box.y0 >= low_.y() && box.x1 <= high_.x() && box.y1 <= high_.y();
  if (!inside) return {highest_, false};
  const auto from = cell_of({box.x0, box.y0}), to = cell_of({box.x1, box.y1});
  GroundBounds bounds{-std::numeric_limits<double>::infinity(), true};
  const Facet* first = nullptr;
  for (int row = from[1]; row <= to[1]; ++row) {
    for (int column = from[0]; column <= to[0]; ++column) {
      const Cell& cell = cells_[row * columns_ + column];
      if (!cell.covered) return {highest_, false};
      bounds.highest = std::max(bounds.highest, cell.highest);
      const Facet& facet = facets_[cell.facet];
      if (!first) first = &facet;
      bounds.plane = bounds.plane && cell.plane && facet.continues(*first);
    }
  }
  return bounds;
}

std::array<int, 2> TriangleRoad::cell_of(const Vector2d& p) const {
  return {static_cast<int>(std::clamp((p.x() - low_.x()) / size_.x(), 0.0, columns_ - 1.0)),
          static_cast<int>(std::clamp((p.y() - low_.y()) / size_.y(), 0.0, rows_ - 1.0))};
}

/// Finds the highest triangle whose plan view covers the point p. The result has no facet if there
/// is none.
TriangleRoad::Hit TriangleRoad::find_covering(const Vector2d& p) const {
  Hit best;
  const auto [column, row] = cell_of(p);
  in_cell(column, row, [&](int number) {
    const Facet& facet = facets_[number];
    if (!facet.covers(p)) return;
    const double z = facet.z(p);
    if (best.facet < 0 || z > best.z) best = {number, z, true};
  });
  return best;
}

TriangleRoad::Hit TriangleRoad::find(const Vector2d& p) const {
  const Hit covering = find_covering(p);
  return covering.facet < 0 ? find_nearest(p) : covering;
}

std::string TriangleRoad::beyond(double x, double y) const {
  if (find_covering({x, y}).inside) return {};
  return fmt::format(
      "no triangle lies at x = {:.6g} m, y = {:.6g} m of its file; all of them are between x = "
      "{:.6g} and {:.6g} m, y = {:.6g} and {:.6g} m",
      x,
      y,
      low_.x(),
      high_.x(),
      low_.y(),
      high_.y());
}

/// Finds the triangle nearest to a point beside the mesh. Rings of grid cells around the point's
/// cell are searched until no closer triangle is possible.
TriangleRoad::Hit TriangleRoad::find_nearest(const Vector2d& p) const {
  const Vector2d within = p.cwiseMax(low_).cwiseMin(high_);
  const auto [column, row] = cell_of(within);
  double least = std::numeric_limits<double>::infinity();
  Hit best;
  const auto look = [&](int c, int r) {
    if (c < 0 || r < 0 || c >= columns_ || r >= rows_) return;
    in_cell(c, r, [&](int number) {
      const Vector2d foot = facets_[number].nearest(p);
      const double distance = (foot - p).norm();
      if (distance < least) {
        least = distance;
        best = {number, facets_[number].z(foot), false};
      }
    });
  };
  const double outside = (p - within).norm();
  for (int ring = 0; ring <= std::max(columns_, rows_); ++ring) {
    // `within` is the point of the grid nearest to the given point. Every cell of this ring is at
    // least `away` from it.
    const double away = std::max(ring - 1, 0) * size_.minCoeff();
    if (std::hypot(away, outside) > least) break;
    for (int i = -ring; i <= ring; ++i) {
      look(column + i, row - ring);
      if (ring > 0) look(column + i, row + ring);
    }
    for (int i = -ring + 1; i < ring; ++i) {
      look(column - ring, row + i);
      look(column + ring, row + i);
    }
  }
  return best;
}

double TriangleRoad::height(double x, double y, double) const { return find({x, y}).z; }

/// Integrates the height triangle by triangle if the triangles along the line are adjacent.
/// Otherwise samples the height.
double TriangleRoad::mean_height(const Vector2d& from, const Vector2d& to, double time) const {
  if (!is_covered({std::min(from.x(), to.x()),
                   std::max(from.x(), to.x()),
                   std::min(from.y(), to.y()),
                   std::max(from.y(), to.y())}))
    return Road::mean_height(from, to, time);
  constexpr double kNext = 1e-9;  // step beyond an edge, as a share of the line
  constexpr int kMost = 4096;     // triangles
  const Vector2d way = to - from;
  double done = 0.0, sum = 0.0;
  for (int i = 0; i < kMost; ++i) {
    const Hit hit = find(from + std::min(1.0, done + kNext) * way);
    if (!hit.inside) break;
    const Facet& facet = facets_[hit.facet];
    const double end = std::max(done + kNext, facet.end_of(from, way));
    const double next = std::min(1.0, end);
    sum += (next - done) * facet.z(from + 0.5 * (done + next) * way);
    done = next;
    if (done >= 1.0) return sum;
  }
  return Road::mean_height(from, to, time);
}

GroundPoint TriangleRoad::at(double x, double y, double) const {
  const Hit hit = find({x, y});
  const Facet& facet = facets_[hit.facet];
  GroundPoint ground;
  ground.height = hit.z;
  ground.friction = facet.friction;
  if (hit.inside) {
    ground.normal = Vector3d(-facet.slope.x(), -facet.slope.y(), 1.0).normalized();
  }
  return ground;
}

}  // namespace latsch::road
