// SPDX-License-Identifier: Apache-2.0
// Response of the steady-state formula to slips that change while the tire rolls, by lagged slips:
//
//   sigma_x dx/dt + |Vx| x = |Vx| kappa         Fx, Fy, ... = Magic Formula(Fz, x, atan y, ...)
//   sigma_y dy/dt + |Vx| y = |Vx| tan alpha     [Pacejka 2012, ch. 7, single contact point]
//
// with the relaxation lengths sigma of the formula at the load, as the rolling tire has them for
// USE_MODE 10 (magic_formula_tire.h). Between two samples slip is linear, and speed and sigma are
// the means of both: exact if speed and sigma are constant, otherwise of order 2. A step of time
// other than the usual one (more than three times as long, or backward) is a gap, after which slips
// start settled; lag_limits() reports it. A sigma of 0 means no lag. Loads are those of the table,
// whatever their cause.
#pragma once

#include <string>
#include <vector>

#include "measurement/channels.h"
#include "models/magic_formula/magic_formula.h"

namespace latsch {

/// Returns what a record cannot show of the lag, one sentence each: gaps after which slips start
/// from their steady values, samples farther apart than a relaxation length, a tire without
/// relaxation lengths.
std::vector<std::string> lag_limits(const magic_formula::MagicFormula& tire,
                                    const std::vector<magic_formula::State>& states,
                                    const std::vector<double>& times);

/// Returns the reason why times cannot be those of a record: there is a single one, or most of them
/// go backward or repeat; empty if they can. `sample` receives the index of the first such sample.
std::string no_record(const std::vector<double>& times, std::size_t& sample);

/// Returns for each sample whether it begins anew: the first one, and every one behind a step of
/// time that is backward, repeated or more than three times the median step.
std::vector<bool> gaps_of(const std::vector<double>& times);
/// Returns a sentence that names the first of these steps; empty if there is none.
std::string gaps_in_words(const std::vector<double>& times);

/// Returns the channels of slip_states.h, sample by sample, with the lagged slips as "kappa" and
/// "alpha" (rad); slopes of `channels` in `parameters`, if any are requested.
Channels lagging_answers(const magic_formula::MagicFormula& tire,
                         const std::vector<magic_formula::State>& states,
                         const std::vector<double>& times,
                         const std::vector<std::string>& channels = {},
                         const std::vector<std::string>& parameters = {});

}  // namespace latsch
