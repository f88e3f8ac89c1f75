// SPDX-License-Identifier: Apache-2.0
// Finds the basins of a function known at the points of a design: the number of its minima, the
// lowest minimum, and the share of the space that leads to each. Reports whether the points are
// dense enough to trust the result.
//
// Every point leads to its lowest neighbor if that neighbor is lower than the point itself. A point
// without a lower neighbor is a minimum, and its basin consists of all points whose path ends
// there. The neighbors of a point are the adjacent points of a grid, including the diagonal ones
// for up to six variables, or the nearest points of a scattered design in the unit cube.
//
// A grid can hide a minimum between two neighbors a and b on a line. This is possible if their
// values differ by less than the possible error of interpolation,
//   |f(b) - f(a)| <= |delta^4 f| / 96,
// where delta^4 f is the fourth difference along the line. The bound is 96 times the error of cubic
// interpolation at the spacing of the grid. Cells beside an extremum of the line are not counted,
// because that extremum is already known. The count of minima is also doubtful if it changes when
// every second level is left out, or if there are fewer than five levels. A scattered design is too
// thin if a plane through the nearest other points explains less than half of the variance of
// points left out.
#pragma once

#include <Eigen/Core>
#include <string>
#include <vector>

namespace latsch {

/// Indices of the neighbors of each point.
using Neighbors = std::vector<std::vector<int>>;

/// Returns the neighbors in a full factorial design, whose first variable changes slowest.
Neighbors grid_neighbors(const std::vector<int>& levels);

/// Returns the `count` nearest points of each point.
Neighbors nearest_neighbors(const std::vector<Eigen::VectorXd>& points, int count);

/// The points of a design from which every descent leads to the same minimum.
struct Basin {
  int lowest = 0;      // index of the basin's minimum
  int points = 0;      // number of points that lead to the minimum, the minimum included
  double value = 0.0;  // value at the minimum
};

/// Returns the basins, lowest first. Points whose value is NaN belong to no basin.
std::vector<Basin> find_basins(const std::vector<double>& values, const Neighbors& neighbors);

/// Returns in words why the number of minima found on a grid cannot be trusted; empty if it can.
std::string grid_doubt(const std::vector<double>& values, const std::vector<int>& levels);

/// Returns in words why the number of minima found among scattered points of the unit cube cannot
/// be trusted; empty if it can.
std::string scatter_doubt(const std::vector<double>& values,
                          const std::vector<Eigen::VectorXd>& points);

}  // namespace latsch
