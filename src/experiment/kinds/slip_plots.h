// SPDX-License-Identifier: Apache-2.0
// Plots the forces of a Magic Formula tire over slip: for several loads, cambers and pressures,
// each varied alone from the nominal state; then both forces together.
#pragma once

#include <vector>

#include "models/magic_formula/magic_formula.h"
#include "report/line_plot.h"

namespace latsch::experiment {

/// Returns Fy and Mz over side slip, Fx over longitudinal slip, Fy over Fx. Returns none for a tire
/// without nominal load; leaves out the curves by pressure if the tire does not depend on it.
std::vector<report::LinePlot> slip_plots(const magic_formula::MagicFormula& tire);

}  // namespace latsch::experiment
