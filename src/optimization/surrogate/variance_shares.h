// SPDX-License-Identifier: Apache-2.0
// Shares of the variance of a response that the variables cause: Sobol's indices [I. Sobol, Math.
// Model. Comput. Exp. 1 (1993) 407], from a polynomial chaos expansion, whose coefficients give
// them in closed form [B. Sudret, Reliab. Eng. Syst. Saf. 93 (2008) 964].
//
//   first of i   share of the terms that contain variable i alone: what would vanish if i alone
//                were known
//   total of i   share of the terms that contain variable i at all: what would remain if all
//                others were known
//
// Variables are uniform between their bounds, in the scale of each. Only as much as the expansion
// explains is known: Q2 is 1 less the squared error at points left out, over the variance, in ten
// parts; in each, the terms are chosen anew. An interval has two parts. The variance that is not
// explained, u = 1 - Q2, may belong to any variable or to none: share (1 - u) .. share (1 - u) + u.
// The scatter of the choice of points is that of ten expansions without a tenth of the points each
// (delete-a-group jackknife), 95 %.
#pragma once

#include <Eigen/Core>
#include <vector>

namespace latsch {

struct VarianceShare {
  double value = 0.0;               // 0 .. 1
  double lower = 0.0, upper = 1.0;  // 95 % interval
};

struct VarianceShares {
  double explained = 0.0;            // Q2; 1: all; may be negative
  std::vector<VarianceShare> first;  // one for each variable
  std::vector<VarianceShare> total;  // one for each variable

  /// True if enough of the variance is explained for the shares to mean something.
  bool is_trusted() const { return explained >= 0.8; }
  /// True if the response does not vary: there are no shares.
  bool is_constant() const { return first.empty(); }
};

/// Points for which shares are computed at least.
constexpr int kFewestPointsOfShares = 20;

/// Returns the shares for values (N) at points (N x n, in the unit cube); N >= 20.
VarianceShares variance_shares(const Eigen::MatrixXd& points, const Eigen::VectorXd& values);

}  // namespace latsch
