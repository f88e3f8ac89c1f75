// SPDX-License-Identifier: Apache-2.0
// Residuals and their derivatives, reduced to what a refit by Gauss-Newton steps needs of them.
//
// Such a refit needs of the residuals r of a group and of their derivatives J only J'J, J'r and
// r'r. The triangular factor R of
//   [J r] = Q R,     R: (n + 1) x (n + 1)
// has the same three products, to rounding, because Q is orthogonal. So thousands of rows become
// n + 1 for each group, and n + 1 new residuals stand for those of the group. A correction of J by
// Broyden's formula needs the residuals themselves: reduced rows serve only where every evaluation
// brings its derivatives.
#pragma once

#include <Eigen/Core>
#include <vector>

#include "optimization/identifiability/confidence.h"

namespace latsch {

/// Places of residuals, group by group.
using RowGroups = std::vector<std::vector<Eigen::Index>>;

/// The reduced rows of one group after those of the other; a group of at most n + 1 rows keeps its
/// own. `whole` has derivatives.
Evaluated reduced_rows(const Evaluated& whole, const RowGroups& groups);

/// The group of every reduced row, in n variables.
std::vector<int> groups_of_reduced_rows(const RowGroups& groups, Eigen::Index n);

}  // namespace latsch
