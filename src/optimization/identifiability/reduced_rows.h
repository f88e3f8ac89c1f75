// SPDX-License-Identifier: Apache-2.0
// Residuals and their derivatives, reduced to the data that a refit by Gauss-Newton steps needs.
//
// Such a refit needs only J'J, J'r and r'r of the residuals r of a group and their derivatives J.
// The triangular factor R of
//   [J r] = Q R,     R: (n + 1) x (n + 1)
// has the same three products, to rounding, because Q is orthogonal. So thousands of rows become n
// + 1 for each group: n + 1 new residuals replace those of the group. A correction of J by
// Broyden's formula needs the residuals themselves, so reduced rows can be used only if every
// evaluation returns derivatives.
#pragma once

#include <Eigen/Core>
#include <vector>

#include "optimization/identifiability/confidence.h"

namespace latsch {

/// Indices of residuals, group by group.
using RowGroups = std::vector<std::vector<Eigen::Index>>;

/// Returns the reduced rows of all groups, one group after the other; a group of at most n + 1 rows
/// keeps its rows. `whole` must have derivatives.
Evaluated reduced_rows(const Evaluated& whole, const RowGroups& groups);

/// Returns the group of every reduced row, for n variables.
std::vector<int> groups_of_reduced_rows(const RowGroups& groups, Eigen::Index n);

}  // namespace latsch
