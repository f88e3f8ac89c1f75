// SPDX-License-Identifier: Apache-2.0
// What a Magic Formula tire does, as curves of force over slip: by load, camber and pressure, each
// alone, from the nominal state; then both forces together.
#pragma once

#include <vector>

#include "models/magic_formula/magic_formula.h"
#include "report/line_plot.h"

namespace latsch::experiment {

/// Fy and Mz over side slip, Fx over longitudinal slip, Fy over Fx. None for a tire without nominal
/// load; those by pressure are left out where the tire does not depend on it.
std::vector<report::LinePlot> slip_plots(const magic_formula::MagicFormula& tire);

}  // namespace latsch::experiment
