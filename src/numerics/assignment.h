// SPDX-License-Identifier: Apache-2.0
// Optimal one-to-one assignment: which column for every row, so that the sum of costs is least.
// Shortest augmenting paths, O(rows^2 columns). [Jonker & Volgenant, Computing 38 (1987) 325-340]
#pragma once

#include <Eigen/Core>
#include <vector>

namespace latsch::numerics {

/// Cost of a pair that must not be made.
inline constexpr double kForbidden = 1e300;

/// partner[row] = column, or -1 where the row stays alone: as many pairs as allowed ones permit, of
/// least total cost. Any shape; costs finite or kForbidden.
std::vector<int> assign(const Eigen::MatrixXd& cost);

}  // namespace latsch::numerics
