// SPDX-License-Identifier: Apache-2.0
// Numbers that steer the search for an equilibrium (equilibrium.h). They were chosen on the shipped
// tires; docs/notebook/fe_tire_solver.md lists what was tried. A user sets the numbers of
// solver_settings.h.
#pragma once

#include "models/fe_tire/analysis/reused_factor.h"

namespace latsch::fe_tire {

struct EquilibriumOptions {
  ReusedFactorOptions factor;

  /// Residual to which linear equations are solved, relative to theirs at the start, 0 to 1. A
  /// smaller one gains nothing, because cords that go slack or taut leave about as much.
  double linear_tolerance = 3e-2;
  /// Tolerance of the equilibrium below which a new tangent is made in every iteration and linear
  /// equations are solved as accurately as Newton's own convergence justifies, from `finest_linear`
  /// to `coarsest_linear`.
  double exact = 1e-7;
  double finest_linear = 1e-4, coarsest_linear = 1e-2;

  /// Multiple of the tolerance, at least 1, within which the iteration ends with the last tangent,
  /// without a new one. A larger multiple saves tangents and takes more iterations.
  double close = 100.0;
  /// Share of the previous residual, 0 to 1, to which it has to fall for that. Cords that go slack
  /// or taut make it fall more slowly at first.
  double closing_ratio = 0.1;
  /// Norm of the residual assumed before the first iteration, relative to the first one.
  double norm_before = 10.0;

  /// Share of the first step that is kept, 0 to 1, if the step ended where the tangent is
  /// indefinite.
  double taken_back = 0.5;
  /// Most halvings of a step.
  int max_backtracks = 10;
  /// Largest |d . f| at the end of a step relative to its start, 0 to 1, with which the step is
  /// accepted although the residual has not fallen.
  double slope_decrease = 0.8;

  /// Most passes that polish the equilibrium with the last tangent. None leaves digits that depend
  /// on the processor.
  int max_polishing = 3;
  /// Residual relative to the accepted one below which the first pass, and the following ones, are
  /// not worth their cost. Smaller values polish more.
  double polished = 1e-3, polished_again = 1e-2;
  /// Residual of the linear equations of a pass, relative to theirs at the start, 0 to 1. It is
  /// small because the load acts through the soft motions of the tire, whose relative error is
  /// larger than the residual's.
  double polishing_tolerance = 1e-3;
};

}  // namespace latsch::fe_tire
