// SPDX-License-Identifier: Apache-2.0
// How good a point is.
#pragma once

#include <vector>

namespace latsch {

/// The target function (less is better) and, where the objective is a sum over residuals, these;
/// where the model knows them, also their derivatives with respect to the values of the point, one
/// row a residual.
struct Score {
  double value = 0.0;
  std::vector<double> residuals = {};
  std::vector<double> jacobian = {};  // empty: not known; DesignSpace::unit_jacobian
  /// Residuals that only stand for a value this point does not have, such as that of a mode without
  /// a partner: from points with more or less of them no slope can be told.
  int stand_ins = 0;
  /// Nonlinear constraints the evaluation reports: fulfilled where c_i <= 0, and where h_j = 0. In
  /// units in which 1 is much.
  std::vector<double> constraints = {};
  std::vector<double> equations = {};

  bool operator==(const Score&) const = default;
};

/// A constraint counts as fulfilled up to this.
constexpr double kFulfilled = 1e-4;

/// The largest of c_i and |h_j|; 0 where all are fulfilled.
double violation(const Score& score);

/// Less of the violation beyond what counts as fulfilled; of two that fulfill everything, the lower
/// target.
bool is_better(const Score& a, const Score& b);

}  // namespace latsch
