// SPDX-License-Identifier: Apache-2.0
// The optimizer of a study.
//
//   [optimizer]
//   method = "auto"               # residual_trust_region, or sqp where there are constraints on
//                                 # channels, which is also what a study without [optimizer] gets;
//                                 # or levenberg_marquardt where trials bring derivatives of their
//                                 # residuals, gss, gss_nlc, nelder_mead, genetic, ensemble
//   step_tolerance = 0.001        # of the range of a variable, as initial_step = 0.1;
//                                 # levenberg_marquardt 0.000001 and 0.5
//   progress_tolerance = 0.001    # levenberg_marquardt: least gain of three steps together,
//                                 # as a share of the target, if the slopes predict little more;
//                                 # that of one measured value unless given
//   outstanding = 1               # points chosen ahead: gss, gss_nlc, residual_trust_region
//   max_steps = 1000              # outcomes the optimizer may observe
//   contraction = 0.25            # gss; gss_nlc 0.5
//   sufficient_decrease = 0.01    # gss, gss_nlc
//   penalty = "l2_squared"        # gss_nlc; or l1, l2, linf, l1_smoothed, l2_smoothed,
//                                 # linf_smoothed: optimization/direct_search/penalty.h
//   penalty_parameter = 1         # gss_nlc: rho at first
//   restarts = 4                  # residual_trust_region: most restarts, if the error exceeds
//                                 # the stated noise or, if none is stated, a thousandth
//                                 # of the first target: to leave local minima, or if variables
//                                 # may be lost (lost_variables.h)
//   difference = 0.0001           # sqp: step of differences, of the range
//   population = 40               # genetic
//   generations = 50              # genetic
//   seed = 1                      # residual_trust_region, genetic
//
// residual_trust_region, levenberg_marquardt and sqp minimize the sum of the squared relative
// errors, whatever exponent the objectives have; the other methods minimize the target itself.
// Every method supports linear constraints (linear_constraints.h). gss_nlc and sqp support
// constraints on channels (channel_constraint.h). An ensemble supports what all its members
// support.
//
// Several methods can run at once and see each other's points (optimization/strategy/ensemble.h):
//
//   [optimizer]
//   method = "ensemble"
//   ends_with = "all"             # or "first": with the first member that ends
//
//   [optimizer.member.wide]       # any name; keys as above, but no other ensemble
//   method = "genetic"
//   priority = 1                  # share of the steps
//
//   [optimizer.member.fine]
//   method = "gss"
//   priority = 2
#pragma once

#include "base/document.h"
#include "optimization/strategy/optimizer_choice.h"

namespace latsch::correlation {

/// Throws InputError naming file, line, found and expected. `constrained` is true if the study has
/// constraints on channels.
OptimizerSettings read_optimizer(const Node& table, const DesignSpace& space, bool constrained);

/// True if the table has a key that read_optimizer reads, other than max_steps.
bool has_optimizer_keys(const Node& table);

/// Returns the known traits of a target made of residuals, as every study's is, before its noise is
/// known.
ProblemTraits traits_of_residuals(const DesignSpace& space, bool constrained);

}  // namespace latsch::correlation
