// SPDX-License-Identifier: Apache-2.0
// Slips that change while the tire rolls, answered by the steady-state formula with slips that lag:
//
//   sigma_x dx/dt + |Vx| x = |Vx| kappa         Fx, Fy, ... = Magic Formula(Fz, x, atan y, ...)
//   sigma_y dy/dt + |Vx| y = |Vx| tan alpha     [Pacejka 2012, ch. 7, single contact point]
//
// with the relaxation lengths sigma of the formula at the load, as the rolling tire has them for
// USE_MODE 10 (magic_formula_tire.h). Between two samples slip goes linearly, and speed and sigma
// are their means: exact where these stand, of order 2 else. A step of time other than the usual
// one (more than three of it, or backward) is a gap, behind which slips begin settled. A sigma of 0
// is no lag. Loads are those of the table: how they come about does not matter.
#pragma once

#include <string>
#include <vector>

#include "measurement/channels.h"
#include "models/magic_formula/magic_formula.h"

namespace latsch {

/// The answers of slip_states.h, sample by sample, with the lagged slips as "kappa" and "alpha"
/// (rad); slopes of `channels` in `parameters`, where any are asked for.
Channels lagging_answers(const magic_formula::MagicFormula& tire,
                         const std::vector<magic_formula::State>& states,
                         const std::vector<double>& times,
                         const std::vector<std::string>& channels = {},
                         const std::vector<std::string>& parameters = {});

}  // namespace latsch
