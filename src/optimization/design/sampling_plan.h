// SPDX-License-Identifier: Apache-2.0
// Points that are chosen without feedback: a design of experiments.
#pragma once

#include <vector>

#include "optimization/problem/design_point.h"

namespace latsch {

struct SamplingPlan {
  std::vector<DesignPoint> points;  // all different, in the order of evaluation
};

}  // namespace latsch
