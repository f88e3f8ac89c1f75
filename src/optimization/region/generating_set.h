// SPDX-License-Identifier: Apache-2.0
// A set of directions one of which points downhill at every point where a smooth function is not
// stationary: the n + 1 vertices of a regular simplex around the origin, the smallest possible set.
//
// A coordinate at a bound contributes its inward axis, and the simplex lies in the other
// coordinates, so the set conforms to the bounds. The simplex is built on the columns q_i of an
// orthogonal matrix,
//   d_0 = -sum q_i / sqrt(n),   d_i = sqrt((n + 1) / n) q_i - (sqrt(n + 1) - 1) / n^1.5 sum q_i,
// which is the Householder matrix I - 2 v v' of the quasi-random direction number `turn`. Over many
// values of `turn` the directions become dense, which a target function with kinks requires: all
// directions of one fixed set can point uphill at a point that is not a minimum. [Kolda, Lewis,
// Torczon, SIAM Review 45 (2003) 385; rotated sets: Abramson, Audet, Dennis, Le Digabel, OrthoMADS,
// SIAM J. Optim. 20 (2009) 948]
#pragma once

#include <Eigen/Core>
#include <vector>

namespace latsch {

enum class Bound { none, lower, upper };

/// Returns unit vectors. `turn` selects the rotation of the simplex; 0 builds it on the coordinate
/// axes. `at[i]` is the bound on which coordinate i lies.
std::vector<Eigen::VectorXd> generating_set(const std::vector<Bound>& at, int turn);

}  // namespace latsch
