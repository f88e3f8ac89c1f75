// SPDX-License-Identifier: Apache-2.0
// A design of experiments: points that are chosen without feedback from evaluations.
#pragma once

#include <vector>

#include "optimization/problem/design_point.h"

namespace latsch {

struct SamplingPlan {
  std::vector<DesignPoint> points;  // all different, in the order of evaluation
};

}  // namespace latsch
