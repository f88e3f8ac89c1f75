// SPDX-License-Identifier: Apache-2.0
// Plots the forces of a Magic Formula tire over slip: for several loads, cambers and pressures,
// each varied alone from the nominal state; then both forces together.
#pragma once

#include <functional>
#include <set>
#include <string>
#include <vector>

#include "models/magic_formula/magic_formula.h"
#include "report/line_plot.h"

namespace latsch::experiment {

/// Knowledge about a tire from its fit.
struct SlipKnowledge {
  std::set<std::string> coefficients;  // fitted or stated by a file; others are assumed
  /// Returns the values (SI) that a condition has in the fitted tests; none if these do not state
  /// it.
  std::function<std::vector<double>(const std::string&)> measured_at;
};

/// Returns Fy and Mz over slip angle, Fx over longitudinal slip, Fy over Fx. Returns none for a
/// tire without nominal load; leaves out the curves by pressure if the tire does not depend on it.
/// If `knowledge` is given, slips outside of the data are shaded, lines of assumed coefficients are
/// dashed and named "assumed", and a load, camber or pressure outside of the data is named
/// "outside".
std::vector<report::LinePlot> slip_plots(const magic_formula::MagicFormula& tire,
                                         const SlipKnowledge* knowledge = nullptr);

}  // namespace latsch::experiment
