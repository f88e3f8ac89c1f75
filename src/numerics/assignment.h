// SPDX-License-Identifier: Apache-2.0
// Optimal one-to-one assignment of columns to rows with the least sum of costs.
// Shortest augmenting paths, O(rows^2 columns). [Jonker & Volgenant, Computing 38 (1987) 325-340]
#pragma once

#include <Eigen/Core>
#include <vector>

namespace latsch::numerics {

/// Cost of a pair that is not allowed.
inline constexpr double kForbidden = 1e300;

/// Returns partner[row] = column, or -1 if the row has no partner. The pairs are as many allowed
/// ones as possible, with the least total cost of these. `cost` may have any shape; its entries are
/// finite or kForbidden.
std::vector<int> assign(const Eigen::MatrixXd& cost);

}  // namespace latsch::numerics
