// SPDX-License-Identifier: Apache-2.0
// Effect of mesh and step size on the identified values: the distance from these values to the
// least sum of squares of the refined model (refinement.h), computed from one trial of the refined
// model.
//
// Let r be the residuals at the identified values, r_f those of the refined model at the same
// values, and J the Jacobian of the unrefined model. The shift is
//   shift = -(J'J)^-1 J' (r_f - r)
// in the variables that no bound holds: the Gauss-Newton step from one least sum of squares to the
// other. Measurement and noise are the same in r and r_f and cancel. The shift is exact for linear
// models whose refinement changes no slope. An interval then extends from one value, with its
// noise, to the other, because the fit cannot decide which of the two is the specimen's. The
// reported value stays that of the unrefined model, with which the model predicts best.
#pragma once

#include <optional>

#include "correlation/study/study.h"
#include "evaluation/executors/executor.h"
#include "evaluation/schedule/run_options.h"
#include "optimization/identifiability/identification.h"

namespace latsch::correlation {

/// Runs the trial of the refined model at that point, with an executor of refined(study). Returns
/// false if it was stopped. Replaces a journal of an older refinement.
bool evaluate_refined(const Study& study,
                      const DesignPoint& point,
                      Executor& executor,
                      const RunOptions& options);

/// Returns the shift in the unit cube, from the journals; nullopt if the study has no refined
/// model, or its trial is missing or failed. A residual that the refined model does not have counts
/// as unchanged.
std::optional<Eigen::VectorXd> refined_shift(const Study& study,
                                             const Identification& identification);

}  // namespace latsch::correlation
