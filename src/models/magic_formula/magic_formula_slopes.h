// SPDX-License-Identifier: Apache-2.0
// Slopes of what the Magic Formula gives in steady state, in its coefficients and in the state:
// exact, by the equations themselves evaluated with dual numbers (dual_lanes.h).
//
// Variables go by the names of parameter_list.h (PKY1, LMUY, FNOMIN ...) and of State (Fz, kappa,
// alpha, gamma, phit, Vx, p); units are SI: dFy/dPKY1 in N, dFy/dalpha in N/rad. What a variable
// does not enter has slope 0, not a small number. One pass serves 63 variables; its cost is some
// two evaluations and what the variables reach: ask those you vary, and the outputs you compare.
//
// Kinks. The slope of |x| at 0 is that for rising x, the one of a sign 0. Where a limit holds (a
// clamped input, E > 1, FZMAX, VXLOW) and at its very edge, it is that of the limited side; at E =
// 1 itself, a usual bound of a fit, that of the free one. Of jumps (Fz = 0, Vx = 0, a switch
// between equations) it is that of the piece the value is of. What a file is silent about (Q_A1 and
// Q_A2, PTY2, LONGITUDINAL_STIFFNESS, LATERAL_STIFFNESS, Q_CAM1 and Q_CAM2, FZMIN, VXLOW at 0)
// switches equations: its slope at 0 is that of the silent file, 0. QSX4, QSX10, LMUV and the like,
// 0 too, have their slope there.
//
// Where an output is not finite, neither need its slopes be: nothing is caught, NaN comes out of
// what is computed with NaN. A variable that does not enter there still has 0.
#pragma once

#include <Eigen/Core>
#include <span>
#include <string>
#include <vector>

#include "models/magic_formula/magic_formula.h"

namespace latsch::magic_formula {

/// One of the outputs: &SteadyState::Fy.
using Output = double SteadyState::*;

struct SteadyStateSlopes {
  Eigen::MatrixXd values;               // (state, output): to the bit what evaluate() gives
  std::vector<Eigen::MatrixXd> slopes;  // of each output: (state, variable)
};

/// d outputs / d variables of many states. Throws InputError where a variable is none, with the
/// nearest name.
SteadyStateSlopes steady_state_slopes(const MagicFormula& tire,
                                      std::span<const State> states,
                                      std::span<const std::string> variables,
                                      std::span<const Output> outputs);
/// The same into what an earlier call has found, so that a search does not ask for new memory at
/// every step, which takes as long as the slopes.
void steady_state_slopes(const MagicFormula& tire,
                         std::span<const State> states,
                         std::span<const std::string> variables,
                         std::span<const Output> outputs,
                         SteadyStateSlopes& found);

}  // namespace latsch::magic_formula
