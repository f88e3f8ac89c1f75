// SPDX-License-Identifier: Apache-2.0
// Full factorial design: every combination of the levels of every variable, bounds included. The
// levels are equally spaced in the unit cube, so geometrically for a logarithmic variable. The
// first variable changes slowest.
#pragma once

#include <vector>

#include "optimization/design/sampling_plan.h"
#include "optimization/problem/design_space.h"

namespace latsch {

/// levels[i] >= 2 values of variable i, or 1: its initial value alone. Throws InputError for
/// another number of levels than variables, a level below 1 or more than a million points.
SamplingPlan full_factorial(const DesignSpace& space, const std::vector<int>& levels);

}  // namespace latsch
