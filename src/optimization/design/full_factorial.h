// SPDX-License-Identifier: Apache-2.0
// Full factorial design: every combination of the levels of every variable, bounds included. The
// levels are equally spaced in the unit cube, so geometrically for a logarithmic variable. The
// first variable changes slowest.
#pragma once

#include <vector>

#include "optimization/design/sampling_plan.h"
#include "optimization/problem/design_space.h"

namespace latsch {

/// `levels[i]` is the number of values of variable i: 2 or more, or 1 for its initial value alone.
/// Throws InputError if the number of levels differs from the number of variables, if a level is
/// below 1, or for more than a million points.
SamplingPlan full_factorial(const DesignSpace& space, const std::vector<int>& levels);

}  // namespace latsch
