// SPDX-License-Identifier: Apache-2.0
// Penalties that turn nonlinear constraints into a part of the target:
//
//   P(x) = f(x) + rho p(v(x)),      v = max(c_i, 0), |h_j|: by how much each is violated
//
//   l1       p = sum v            l2       p = |v|_2            linf     p = max v
//   l2_squared   p = |v|_2^2
//
// Those of the first line are exact, with the solution itself at a finite rho, and have kinks on
// the constraints; the squared one is smooth and reaches the solution as rho grows. Smoothed, with
// alpha > 0, the kinks are rounded over a width of alpha:
//
//   l1       sum  alpha ln(1 + e^(c_i/alpha)),   alpha ln(e^(h_j/alpha) + e^(-h_j/alpha))
//   l2       sqrt(|v|_2^2 + alpha^2)
//   linf     alpha ln(1 + sum e^(c_i/alpha) + sum (e^(h_j/alpha) + e^(-h_j/alpha)))
//
// above the exact ones by at most alpha ln 2 a constraint, alpha, and alpha ln(1 + terms).
// [Griffin & Kolda, Appl. Math. Res. Express 2010, 36; names as in HOPSPACK]
#pragma once

#include <string>
#include <string_view>
#include <vector>

#include "optimization/problem/score.h"

namespace latsch {

enum class Penalty { l2_squared, l1, l2, linf, l1_smoothed, l2_smoothed, linf_smoothed };

/// "l2_squared" ...
std::string_view name(Penalty penalty);
const std::vector<std::string>& penalty_names();
/// Of one of penalty_names().
Penalty penalty_of(std::string_view name);

bool is_smoothed(Penalty penalty);

/// p of the constraints of a score; without rho.
double penalty(Penalty kind, const Score& score, double alpha);

}  // namespace latsch
