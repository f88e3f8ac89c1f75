// SPDX-License-Identifier: Apache-2.0
// Derivatives of the steady-state results of the Magic Formula with respect to its coefficients and
// the state. They are exact: the equations themselves are evaluated with dual numbers
// (dual_lanes.h).
//
// Variables have the names of parameter_list.h (PKY1, LMUY, FNOMIN ...) and of State (Fz, kappa,
// alpha, gamma, phit, Vx, p). Units are SI: dFy/dPKY1 in N, dFy/dalpha in N/rad. If an output does
// not depend on a variable, its slope is 0, not a small number. One pass serves 63 variables. It
// costs about two evaluations plus the equations that depend on the variables, so request only the
// variables you vary and the outputs you compare.
//
// At kinks, slopes follow these rules. The slope of |x| at 0 is that for increasing x; the slope of
// sign(x) at 0 is 0. At and beyond a limit (a clamped input, E > 1, FZMAX, VXLOW) the slope is that
// of the limited side. At E = 1 itself, a usual bound of a fit, it is that of the side E < 1. At
// jumps (Fz = 0, Vx = 0, a switch between equations) it is that of the branch to which the value
// belongs. Parameters whose absence from a file switches equations (Q_A1 and Q_A2, PTY2,
// LONGITUDINAL_STIFFNESS, LATERAL_STIFFNESS, Q_CAM1 and Q_CAM2, FZMIN, VXLOW at 0) have the slope 0
// if they are 0. Other parameters that are 0 by default, such as QSX4, QSX10 and LMUV, have their
// proper slope at 0.
//
// If an output is not finite, its slopes need not be finite either: NaN results from computations
// with NaN. A variable without effect still has slope 0.
#pragma once

#include <Eigen/Core>
#include <span>
#include <string>
#include <vector>

#include "models/magic_formula/magic_formula.h"

namespace latsch::magic_formula {

/// An output of the formula as a pointer to a member of SteadyState, for example &SteadyState::Fy.
using Output = double SteadyState::*;

struct SteadyStateSlopes {
  Eigen::MatrixXd values;  // rows: states, columns: outputs; identical to evaluate() to the bit
  // For each output a matrix; rows: states, columns: variables.
  std::vector<Eigen::MatrixXd> slopes;
};

/// Returns the derivatives of the outputs with respect to the variables for many states. Throws
/// InputError for an unknown variable and proposes the most similar name.
SteadyStateSlopes steady_state_slopes(const MagicFormula& tire,
                                      std::span<const State> states,
                                      std::span<const std::string> variables,
                                      std::span<const Output> outputs);
/// Computes the derivatives into the result of an earlier call. Allocating a new result at every
/// step of a search would take as long as computing it.
void steady_state_slopes(const MagicFormula& tire,
                         std::span<const State> states,
                         std::span<const std::string> variables,
                         std::span<const Output> outputs,
                         SteadyStateSlopes& found);

}  // namespace latsch::magic_formula
