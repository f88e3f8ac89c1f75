// SPDX-License-Identifier: Apache-2.0
// The optimizer of a study. residual_trust_region, levenberg_marquardt and sqp minimize the sum of
// the squared relative errors, whatever the exponent of the objective; the other methods minimize
// the target itself. Every method supports linear constraints (linear_constraints.h); gss_nlc and
// sqp also support constraints on channels (channel_constraint.h). An ensemble, several methods
// that run at once and see each other's points (optimization/strategy/ensemble.h), supports what
// all its members support. The keys are in correlation/study/keys/optimizer_keys.cpp.
#pragma once

#include "base/document.h"
#include "optimization/strategy/optimizer_choice.h"

namespace latsch::correlation {

/// Throws InputError naming file, line, found and expected. `constrained` is true if the study has
/// constraints on channels.
OptimizerSettings read_optimizer(const Node& table, const DesignSpace& space, bool constrained);

/// True if the table has a key that read_optimizer reads, other than max_steps.
bool has_optimizer_keys(const Node& table);

/// Returns the traits of a target that is made of residuals, as that of every study is, before its
/// noise is known.
ProblemTraits traits_of_residuals(const DesignSpace& space, bool constrained);

}  // namespace latsch::correlation
