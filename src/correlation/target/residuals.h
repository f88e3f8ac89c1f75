// SPDX-License-Identifier: Apache-2.0
// The measured values of a study as one vector of residuals, independent of the target's exponents.
//
// Fit and intervals use the same residuals, which are proportional to those of objective(). For
// each of the N values of a fitted experiment of positive weight w, with d its difference as
// compared,
//   r = sqrt(w) d / sigma        if the experiments state their noise (measurement_noise.h), or if
//                                it is estimated (estimated_noise.h), and is in units of a common
//                                spread that is estimated from the fit, or
//   r = sqrt(w n / N) d          otherwise, with n the mean of all N; the weights then express how
//                                far values can be trusted, and the common spread of sqrt(w) d is
//                                estimated from the fit
// Both are taken after a robust loss. The distribution of r is stated separately: its deviation is
// sqrt(w), or sqrt(n / N), in units of the spread, because a weight or a mean over few values makes
// a value count more but not more exact. Values of a curve or a load-deflection test share noise
// with their neighbors. The differences are those at the best nuisance numbers
// (nuisance_solver.h). Priors of nuisance numbers and then of variables (variables.h) follow, one
// residual each. A measured mode without a partner is NaN, because its derivative is not known.
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "correlation/study/study.h"
#include "evaluation/trial/evaluator.h"
#include "optimization/identifiability/residual_noise.h"

namespace latsch::correlation {

/// Returns 1 if the study states the noise of its experiments, nullopt if it has to be estimated.
std::optional<double> residual_sigma(const Study& study);

/// Returns how many nuisance numbers every trial solves and experiment `e` counts; held ones do not
/// count.
int solved_numbers(const Study& study, std::size_t e);

/// Returns the distribution of the residuals.
ResidualTraits residual_traits(const Study& study);

/// Returns an objective with the residuals of the study and their sum of squares as its value.
Objective residual_objective(const Study& study);

/// Returns the difference d, before a robust loss, that corresponds to this residual of an
/// experiment. With stated noise the mean over the experiment's values is used.
double difference_of(const Study& study, int experiment, double residual);

/// Describes one residual: a measured value, or a prior.
struct ResidualRow {
  int experiment = 0;    // index in the study; -1: a prior, of a variable or of a nuisance number
  std::string name;      // "10 mm", "radial n=2"
  double unit = 1.0;     // difference d that makes a residual of 1, without a robust loss
  int nuisance_of = -1;  // for a prior of a nuisance number: index of the experiment that counts it

  /// Returns the experiment to which the row belongs; -1 for the prior of a variable.
  int owner() const { return experiment < 0 ? nuisance_of : experiment; }
};

/// Returns a row for every residual, in their order.
std::vector<ResidualRow> residual_rows(const Study& study);

/// Returns how many of the residuals are priors, of nuisance numbers and of variables; these come
/// last, in this order.
std::size_t prior_count(const Study& study);

}  // namespace latsch::correlation
