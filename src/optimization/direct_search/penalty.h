// SPDX-License-Identifier: Apache-2.0
// Penalties that turn nonlinear constraints into a part of the target:
//
//   P(x) = f(x) + rho p(v(x)),      v = max(c_i, 0), |h_j|: the amount each is violated by
//
//   l1       p = sum v            l2       p = |v|_2            linf     p = max v
//   l2_squared   p = |v|_2^2
//
// The penalties of the first line are exact: they have the solution itself at a finite rho, and
// kinks on the constraints. The squared one is smooth and approaches the solution as rho grows. The
// smoothed penalties, with alpha > 0, round the kinks over a width of alpha:
//
//   l1       sum  alpha ln(1 + e^(c_i/alpha)),   alpha ln(e^(h_j/alpha) + e^(-h_j/alpha))
//   l2       sqrt(|v|_2^2 + alpha^2)
//   linf     alpha ln(1 + sum e^(c_i/alpha) + sum (e^(h_j/alpha) + e^(-h_j/alpha)))
//
// They exceed the exact ones by at most alpha ln 2 for each constraint (l1), by alpha (l2), and by
// alpha ln(1 + terms) (linf).
// [Griffin & Kolda, Appl. Math. Res. Express 2010, 36; names as in HOPSPACK]
#pragma once

#include <string>
#include <string_view>
#include <vector>

#include "optimization/problem/score.h"

namespace latsch {

/// Kinds of penalties, by the norm of the violations.
enum class Penalty { l2_squared, l1, l2, linf, l1_smoothed, l2_smoothed, linf_smoothed };

/// Returns the name of a kind, for example "l2_squared".
std::string_view name(Penalty penalty);
/// Returns the names of all kinds.
const std::vector<std::string>& penalty_names();
/// Returns the kind with the given name, which must be one of penalty_names().
Penalty penalty_of(std::string_view name);

/// True if the penalty is differentiable where a constraint becomes violated.
bool is_smoothed(Penalty penalty);

/// Returns the penalty p of the constraints of a score, without the factor rho.
double penalty(Penalty kind, const Score& score, double alpha);

}  // namespace latsch
