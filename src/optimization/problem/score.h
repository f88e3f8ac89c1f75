// SPDX-License-Identifier: Apache-2.0
// The outcome of an evaluated point.
#pragma once

#include <vector>

namespace latsch {

/// The target function (less is better), the residuals if the objective is a sum over residuals,
/// and their derivatives with respect to the values of the point if the model knows them, one row
/// for each residual.
struct Score {
  double value = 0.0;                  // the target
  std::vector<double> residuals = {};  // empty: the target is no sum over residuals
  std::vector<double> jacobian = {};   // empty: not known; see DesignSpace::unit_jacobian
  /// Number of residuals that stand in for a value this point does not have, such as that of a mode
  /// without a partner. No slope can be computed between points with different numbers of
  /// stand-ins.
  int stand_ins = 0;
  /// Nonlinear constraints computed by the evaluation, fulfilled if c_i <= 0 and h_j = 0. A value
  /// of 1 should be a large violation.
  std::vector<double> constraints = {};
  std::vector<double> equations = {};  // h_j

  bool operator==(const Score&) const = default;
};

/// Violation up to which a constraint counts as fulfilled. A larger value accepts points farther
/// off.
constexpr double kFulfilled = 1e-4;

/// Returns the largest of c_i and |h_j|; 0 if all are fulfilled.
double violation(const Score& score);

/// True if a violates the constraints less than b beyond the tolerance, or if both fulfill all and
/// a has the lower target.
bool is_better(const Score& a, const Score& b);

}  // namespace latsch
