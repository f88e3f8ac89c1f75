// SPDX-License-Identifier: Apache-2.0
// The outcome of an evaluated point.
#pragma once

#include <vector>

namespace latsch {

/// The result of an evaluation: the target function (less is better), the residuals if the target
/// is a sum over residuals, and, if the model computes them, the derivatives of the residuals with
/// respect to the values of the point, one row for each residual.
struct Score {
  double value = 0.0;                  // the target
  std::vector<double> residuals = {};  // empty: the target is not a sum over residuals
  /// Empty: derivatives are not known; see DesignSpace::unit_jacobian.
  std::vector<double> jacobian = {};
  /// Number of residuals that replace a value which does not exist at this point, such as that of a
  /// mode without a partner (stand-ins). Points with different numbers of stand-ins give no slope.
  int stand_ins = 0;
  /// Values of the nonlinear constraints, fulfilled if c_i <= 0 and h_j = 0. They should be scaled
  /// so that 1 is a large violation.
  std::vector<double> constraints = {};
  std::vector<double> equations = {};  // h_j

  bool operator==(const Score&) const = default;
};

/// Violation up to which a constraint counts as fulfilled. A larger value accepts points that
/// violate it more.
constexpr double kFulfilled = 1e-4;

/// Returns the largest of c_i and |h_j|; 0 if all are fulfilled.
double violation(const Score& score);

/// True if the constraints of a are violated less than those of b, beyond the tolerance, or if both
/// fulfill all constraints and the target of a is lower.
bool is_better(const Score& a, const Score& b);

}  // namespace latsch
