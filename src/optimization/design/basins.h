// SPDX-License-Identifier: Apache-2.0
// Basins of a function known at the points of a design: how many minima there are, which is the
// lowest, how much of the space leads to it; and whether the points are dense enough to trust that.
//
// Every point leads to the lowest of its neighbors, where that is lower than itself; a point that
// leads nowhere is a minimum, and its basin are all points that end there. Neighbors are the
// adjacent points of a grid, for up to six variables the diagonal ones too, or the nearest points
// of a scattered design in the unit cube.
//
// A grid can hide a minimum between two neighbors on a line of its own where the values differ by
// less than what interpolation may miss,
//   |f(b) - f(a)| <= |delta^4 f| / 96,
// delta^4: the fourth difference along the line, six times what four neighbors at twice the spacing
// miss of a point in their middle, 96 times at the spacing itself. Cells beside an extremum of the
// line are no news. A count of minima that changes when every other level is left out is not
// settled either, and fewer than five levels do not tell. A scattered design is too thin where a
// plane through the nearest others explains less than half of the variance of points left out.
#pragma once

#include <Eigen/Core>
#include <string>
#include <vector>

namespace latsch {

/// Places of the neighbors of each point.
using Neighbors = std::vector<std::vector<int>>;

/// Of a full factorial design, first variable slowest.
Neighbors grid_neighbors(const std::vector<int>& levels);

/// The `count` nearest points of each.
Neighbors nearest_neighbors(const std::vector<Eigen::VectorXd>& points, int count);

struct Basin {
  int lowest = 0;  // place of its minimum
  int points = 0;  // that lead there, the minimum included
  double value = 0.0;
};

/// Lowest first. Points without a value, NaN, belong to no basin.
std::vector<Basin> find_basins(const std::vector<double>& values, const Neighbors& neighbors);

/// Why the minima of a grid cannot be trusted, in words; empty where they can.
std::string grid_doubt(const std::vector<double>& values, const std::vector<int>& levels);

/// The same for scattered points of the unit cube.
std::string scatter_doubt(const std::vector<double>& values,
                          const std::vector<Eigen::VectorXd>& points);

}  // namespace latsch
