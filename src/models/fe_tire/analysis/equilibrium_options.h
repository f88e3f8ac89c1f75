// SPDX-License-Identifier: Apache-2.0
// Options of the search for an equilibrium (equilibrium.h). They were chosen on the shipped tires;
// docs/notebook/fe_tire_solver.md lists what was tried. Users do not set these options, but those
// of solver_settings.h.
#pragma once

#include "models/fe_tire/analysis/reused_factor.h"

namespace latsch::fe_tire {

struct EquilibriumOptions {
  ReusedFactorOptions factor;

  /// Relative tolerance of the linear solves, 0 to 1. A smaller one gains nothing, because cords
  /// that become slack or taut leave an error of about this size.
  double linear_tolerance = 3e-2;
  /// If the tolerance of the equilibrium is smaller than `exact`, every iteration computes a new
  /// tangent. The linear equations are then solved as accurately as the convergence of Newton's
  /// method justifies, with tolerances from `finest_linear` to `coarsest_linear`.
  double exact = 1e-7;
  double finest_linear = 1e-4, coarsest_linear = 1e-2;

  /// The iteration ends with the last tangent, without computing a new one, if the residual is
  /// below this multiple of the tolerance, at least 1. A larger multiple saves tangents but needs
  /// more iterations.
  double close = 100.0;
  /// The iteration ends with the last tangent only if the residual has fallen to this share of the
  /// previous one, 0 to 1. Cords that become slack or taut slow this decrease at first.
  double closing_ratio = 0.1;
  /// Residual norm assumed before the first iteration, as a multiple of the first residual.
  double norm_before = 10.0;

  /// Share of the first step that is kept, 0 to 1, if the tangent at the end of this step is
  /// indefinite.
  double taken_back = 0.5;
  /// Largest number of halvings of a step in the line search.
  int max_backtracks = 10;
  /// A step is accepted although the residual has not fallen if |d . f| at its end is at most this
  /// share of that at its start, 0 to 1.
  double slope_decrease = 0.8;

  /// Largest number of additional steps with the last tangent after convergence. Without them,
  /// digits of the result would depend on the processor.
  int max_polishing = 3;
  /// Residuals relative to the accepted one below which the first additional step, and the
  /// following ones, are omitted. Smaller values cause more steps.
  double polished = 1e-3, polished_again = 1e-2;
  /// Relative tolerance of the linear solves in the additional steps, 0 to 1. It is small because
  /// the load acts through the softest motions of the tire, whose relative error is larger than
  /// that of the residual.
  double polishing_tolerance = 1e-3;
};

}  // namespace latsch::fe_tire
