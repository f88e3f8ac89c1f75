// SPDX-License-Identifier: Apache-2.0
// The measured values of a study as one vector of residuals, whatever the target makes of them.
//
// The target (3) is a mean of absolute errors; what the data determine follows from the errors
// themselves. Of every value of a fitted experiment with positive weight w
//   r = d / noise           where the study states the noise of the experiments, or
//   r = sqrt(w) d           where not: the weights then stand for how far the values can be
//   trusted,
//                           and their common spread is estimated from the fit
// with d the relative errors (1), (2). A measured mode without a partner is NaN: nothing is known
// about its derivative.
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "correlation/study.h"
#include "evaluation/evaluator.h"

namespace latsch::correlation {

/// 1 where the study states the noise of its experiments, nullopt where it has to be estimated.
std::optional<double> residual_sigma(const Study& study);

/// The residuals with their sum of squares as the value: an objective.
Objective residual_objective(const Study& study);

/// One measured value.
struct ResidualRow {
  int experiment = 0;  // place in the study
  std::string name;    // "10 mm", "radial n=2"
};

/// Of every residual, in their order.
std::vector<ResidualRow> residual_rows(const Study& study);

}  // namespace latsch::correlation
