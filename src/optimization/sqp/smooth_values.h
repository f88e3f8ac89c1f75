// SPDX-License-Identifier: Apache-2.0
// What an evaluation says of a smooth problem with constraints, and its derivatives in the unit
// cube:
//
//   least f(u)  with  c(u) <= 0  and  h(u) = 0;      f = |r(u)|^2  where residuals r are known
//
// Derivatives are those the model knows, or differences along directions d_j that stay inside the
// region:  J d_j = (F(u + t_j d_j) - F(u)) / t_j  for the values F of all functions.
#pragma once

#include <Eigen/Core>
#include <optional>

#include "optimization/problem/score.h"

namespace latsch {

struct SmoothValues {
  double f = 0.0;
  Eigen::VectorXd r;  // empty: none are known
  Eigen::VectorXd c, h;

  double violation() const;
};

/// nullopt where a value is not finite.
std::optional<SmoothValues> smooth_values(const Score& score);

/// As many residuals and constraints.
bool same_shape(const SmoothValues& a, const SmoothValues& b);

/// Gradient of f, Jacobians of the others, one row a function.
struct SmoothSlopes {
  Eigen::VectorXd g;
  Eigen::MatrixXd r, c, h;
};

/// Of the values F of all functions one after the other: f or, where they are known, residuals,
/// then c, h.
Eigen::VectorXd all_values(const SmoothValues& values);

/// `J`: derivatives of all_values(values), a row each.
SmoothSlopes slopes_at(const SmoothValues& values, const Eigen::MatrixXd& J);

/// The J with J D = S of least norm; directions as columns of D, differences as columns of S.
Eigen::MatrixXd jacobian_of(const Eigen::MatrixXd& S, const Eigen::MatrixXd& D);

}  // namespace latsch
