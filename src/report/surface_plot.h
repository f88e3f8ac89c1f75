// SPDX-License-Identifier: Apache-2.0
// Plot of the target over two design variables: filled contours with the minima marked.
#pragma once

#include <string>
#include <vector>

#include "report/report.h"

namespace latsch::report {

/// A grid point none of whose eight neighbors has a lower target. A plateau counts as one minimum;
/// failed points are ignored.
struct GridMinimum {
  int i = 0, j = 0;
  double target = 0.0;
};

/// Returns the local minima in ascending order of the target.
std::vector<GridMinimum> local_minima(const Eigen::MatrixXd& target);

std::string surface_plot(const Surface& surface);

}  // namespace latsch::report
