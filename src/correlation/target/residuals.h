// SPDX-License-Identifier: Apache-2.0
// The measured values of a study as one vector of residuals, whatever the target makes of them.
//
// Fit and intervals use the same: residuals here are in proportion to those of objective(). Of each
// of the N values of a fitted experiment of positive weight w, with d its difference as compared,
//   r = sqrt(w) d / sigma        where the experiments state their noise (measurement_noise.h) or
//                                it is estimated (estimated_noise.h), then in units of a common
//                                spread that is estimated from the fit, or
//   r = sqrt(w n / N) d          where not, n the mean of all N; the weights then stand for how far
//                                values can be trusted, and the common spread of sqrt(w) d is
//                                estimated from the fit
// both after a robust loss. How r is distributed is told beside: its deviation is sqrt(w), or
// sqrt(n / N), in units of the spread, because a weight or a mean over few values makes a value
// count more and not more exact; and values of a curve or a load-deflection test share noise with
// their neighbors. Priors of variables (variables.h) follow, one residual each. A measured mode
// without a partner is NaN: nothing is known about its derivative.
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "correlation/study/study.h"
#include "evaluation/trial/evaluator.h"
#include "optimization/identifiability/residual_noise.h"

namespace latsch::correlation {

/// 1 where the study states the noise of its experiments, nullopt where it has to be estimated.
std::optional<double> residual_sigma(const Study& study);

/// How they are distributed.
ResidualTraits residual_traits(const Study& study);

/// The residuals with their sum of squares as the value: an objective.
Objective residual_objective(const Study& study);

/// The difference d, without a robust loss, that makes such a residual of an experiment; with
/// stated noise in the mean of its values.
double difference_of(const Study& study, int experiment, double residual);

/// One measured value.
struct ResidualRow {
  int experiment = 0;  // place in the study; -1: a prior
  std::string name;    // "10 mm", "radial n=2"
  double unit = 1.0;   // the difference d that makes a residual of 1, but for a robust loss
};

/// Of every residual, in their order.
std::vector<ResidualRow> residual_rows(const Study& study);

/// How many of them are priors of variables, the last ones.
std::size_t prior_count(const Study& study);

}  // namespace latsch::correlation
