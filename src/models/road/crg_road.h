// SPDX-License-Identifier: Apache-2.0
// A curved regular grid: heights on a grid along a reference line, the surface of OpenCRG
// [ASAM OpenCRG 1.2.0, concept paper].
//
//   u  along the line, every `u_increment`; v  to its left, at any increasing positions
//   z(u, v) = line height(u) + banking(u) v + grid(u, v)
//
// Heights and banking are linear between rows, and the grid is bilinear. In the interval k between
// the points P_k and P_k+1 of the line, v is the distance from the line through both. u is
// interpolated linearly, parallel to this line, between the normal to P_k-1 P_k+1 through P_k and
// the normal to P_k P_k+2 through P_k+1. Beyond both ends the line continues straight. At a point
// closer to a center of curvature than the line itself the coordinates are not unique, as in
// OpenCRG.
//
// Beyond the grid the border modes of OpenCRG hold:
//   none     no road: elevation() returns nothing there, but at() keeps the edge for tires
//   zero     z = border_offset
//   keep     the edge continues, raised by border_offset
//   repeat   the grid begins again; reflect: it returns mirrored
#pragma once

#include <optional>

#include "models/road/line_index.h"
#include "models/road/road.h"

namespace latsch::road {

struct CrgGrid {
  enum class Border { none, zero, keep, repeat, reflect };

  double u_begin = 0.0;               // m
  double u_increment = 1.0;           // m
  std::vector<Eigen::Vector2d> line;  // m, at least two points
  std::vector<double> line_height;    // m, height of the line at each row
  std::vector<double> banking;        // slope across at each row, or empty
  std::vector<double> v;              // m, at least two positions, increasing
  std::vector<double> z;              // m, heights row by row, v from right to left
  // One entry per z, or empty; true: z is a guess, and elevation() returns nothing there.
  std::vector<bool> missing;

  Border border_u = Border::keep, border_v = Border::keep;
  double border_offset_u = 0.0, border_offset_v = 0.0;  // m
  // Length at each end over which z fades in from the line's height, m.
  double smooth_begin = 0.0, smooth_end = 0.0;
  bool closed = false;  // the end of the line joins its start, if possible

  int rows() const { return static_cast<int>(line.size()); }
  double u_end() const { return u_begin + u_increment * (rows() - 1); }
};

class CrgRoad final : public Road {
 public:
  struct Position {
    double u = 0.0, v = 0.0;  // m
  };

  explicit CrgRoad(CrgGrid grid);

  GroundPoint at(double x, double y, double time) const override;
  double height(double x, double y, double time) const override;
  /// Returns the reason why a point is off the road: it lies beside the grid, unless the file has
  /// the grid repeated or reflected there. Gaps in the grid, which the file fills, count as road.
  std::string beyond(double x, double y) const override;
  /// Returns the mean height by integration from one grid line to the next, which is exact because
  /// the height between them is a quadratic polynomial.
  double mean_height(const Eigen::Vector2d& from,
                     const Eigen::Vector2d& to,
                     double time) const override;
  /// Returns the maximum of the surrounding grid heights if the box lies inside the grid of a
  /// straight line. Otherwise returns no bound.
  GroundBounds bounds(const GroundBox& box, double time) const override;

  Position locate(double x, double y) const;
  Eigen::Vector2d point(const Position& position) const;
  /// Returns the height, m, or nothing if the file has no road at this position.
  std::optional<double> elevation(const Position& position) const;
  const CrgGrid& grid() const { return grid_; }

 private:
  struct Interval {
    int number = 0;  // index of the interval, which lies between points number and number + 1
    // Position in the interval, 0 to 1; outside this range beyond the ends of the line.
    double part = 0.0;
    double v = 0.0;
    Eigen::Vector2d along_u;  // derivatives of the position (x, y) by u and v
    Eigen::Vector2d along_v;
  };
  struct Place {
    int row = 0;
    double part = 0.0;
    // Sign of the derivative by the position; 0 if the height of the edge is kept.
    double sign = 1.0;
    bool outside = false;
  };
  struct Elevation {
    double z = 0.0, dz_du = 0.0, dz_dv = 0.0;
    bool missing = false;
  };

  Eigen::Vector2d tangent(int point) const;
  Eigen::Vector2d miter(int point, const Eigen::Vector2d& normal) const;
  Interval interval(const Eigen::Vector2d& p) const;
  void find_closure();
  double wrapped(double u) const;
  double u_of(const Interval& place) const;
  Place along(double u) const;
  Place across(double v) const;
  Elevation evaluate(double u, double v) const;
  void add_grid(const Place& u, const Place& v, Elevation& result) const;
  void add_line(const Place& u, const Place& v, Elevation& result) const;
  void smoothen(double u, Elevation& result) const;

  CrgGrid grid_;
  LineIndex index_;
  bool straight_ = false, even_v_ = false, closed_ = false;
  double close_min_ = 0.0, close_max_ = 0.0;
  Eigen::Vector2d first_, last_;  // unit vectors along the line at its start and end
};

}  // namespace latsch::road
