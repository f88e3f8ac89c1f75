// SPDX-License-Identifier: Apache-2.0
// The target over two design variables: filled contours with the minima marked.
#pragma once

#include <string>
#include <vector>

#include "report/report.h"

namespace latsch::report {

/// Grid point with no lower neighbor among the eight around it. Plateaus count once, failed points
/// not at all.
struct GridMinimum {
  int i = 0, j = 0;
  double target = 0.0;
};

/// Returns the minima ascending by target, so the first is the lowest of the grid.
std::vector<GridMinimum> local_minima(const Eigen::MatrixXd& target);

std::string surface_plot(const Surface& surface);

}  // namespace latsch::report
