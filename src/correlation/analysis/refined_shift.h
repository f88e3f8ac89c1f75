// SPDX-License-Identifier: Apache-2.0
// What mesh and step make of the numbers: how far from those found the refined model (refinement.h)
// has its least sum of squares, from one trial of it.
//
// With r the residuals at the numbers found, r_f those of the refined model at the same numbers and
// J of the model as it is,
//   shift = -(J'J)^-1 J' (r_f - r)
// in the variables that no bound holds: the step of Gauss and Newton from the one least sum of
// squares to the other. Measurement and its noise are the same in r and r_f and cancel. Exact for
// linear models whose refinement changes no slope. An interval then reaches from the one number,
// with its noise, to the other: which of them is the specimen's, nobody knows who has fitted. The
// value stays that of the model as it is, with which it predicts best.
#pragma once

#include <optional>

#include "correlation/study/study.h"
#include "evaluation/executors/executor.h"
#include "evaluation/schedule/run_options.h"
#include "optimization/identifiability/identification.h"

namespace latsch::correlation {

/// The trial of the refined model at that point, with an executor of refined(study); false where it
/// was stopped. A journal of an older refinement makes room.
bool evaluate_refined(const Study& study,
                      const DesignPoint& point,
                      Executor& executor,
                      const RunOptions& options);

/// In the unit cube, from the journals; nullopt where the study has no refined model, or its trial
/// is missing or failed. A residual that the refined model does not know counts as unchanged.
std::optional<Eigen::VectorXd> refined_shift(const Study& study,
                                             const Identification& identification);

}  // namespace latsch::correlation
