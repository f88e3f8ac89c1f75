// SPDX-License-Identifier: Apache-2.0
// The target over two design variables: filled contours with the minima marked.
#pragma once

#include <string>
#include <vector>

#include "report/report.h"

namespace latsch::report {

/// A grid point with no lower neighbor among the eight around it; plateaus count once, failed
/// points not at all.
struct GridMinimum {
  int i = 0, j = 0;
  double target = 0.0;
};

/// Ascending by target: the first is the lowest of the grid.
std::vector<GridMinimum> local_minima(const Eigen::MatrixXd& target);

std::string surface_plot(const Surface& surface);

}  // namespace latsch::report
