// SPDX-License-Identifier: Apache-2.0
// The values of a smooth problem with constraints at a point, and their derivatives in the unit
// cube:
//
//   minimize f(u)  with  c(u) <= 0  and  h(u) = 0;      f = |r(u)|^2  if residuals r are known
//
//
// Derivatives are those of the model if it computes them. Otherwise they are differences along
// directions d_j that stay inside the region:  J d_j = (F(u + t_j d_j) - F(u)) / t_j  for the
// values F of all functions.
#pragma once

#include <Eigen/Core>
#include <optional>

#include "optimization/problem/score.h"

namespace latsch {

struct SmoothValues {
  double f = 0.0;
  Eigen::VectorXd r;  // residuals; empty: not known
  Eigen::VectorXd c, h;

  double violation() const;
};

/// Returns the values of a score; nullopt if one is not finite.
std::optional<SmoothValues> smooth_values(const Score& score);

/// True if both have equal numbers of residuals and of constraints.
bool same_shape(const SmoothValues& a, const SmoothValues& b);

/// The gradient g of f and the Jacobians of the other functions, one row for each function.
struct SmoothSlopes {
  Eigen::VectorXd g;
  Eigen::MatrixXd r, c, h;
};

/// Returns the values F of all functions one after the other: the residuals if they are known, else
/// f; then c and h.
Eigen::VectorXd all_values(const SmoothValues& values);

/// Returns the slopes from `J`, which holds the derivatives of all_values(values), one row for each
/// value.
SmoothSlopes slopes_at(const SmoothValues& values, const Eigen::MatrixXd& J);

/// Returns the J of least norm that fulfills J D = S. The columns of D are directions, those of S
/// the differences of the values along them.
Eigen::MatrixXd jacobian_of(const Eigen::MatrixXd& S, const Eigen::MatrixXd& D);

}  // namespace latsch
