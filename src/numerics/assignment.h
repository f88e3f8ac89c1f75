// SPDX-License-Identifier: Apache-2.0
// Optimal one-to-one assignment of columns to rows with the least sum of costs.
// Shortest augmenting paths, O(rows^2 columns). [Jonker & Volgenant, Computing 38 (1987) 325-340]
#pragma once

#include <Eigen/Core>
#include <vector>

namespace latsch::numerics {

/// Cost of a pair that is not allowed.
inline constexpr double kForbidden = 1e300;

/// Returns partner[row] = column, or -1 if the row has no partner: the largest number of allowed
/// pairs, at least total cost. `cost` may have any shape; entries are finite or kForbidden.
std::vector<int> assign(const Eigen::MatrixXd& cost);

}  // namespace latsch::numerics
