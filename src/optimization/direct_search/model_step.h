// SPDX-License-Identifier: Apache-2.0
// Step of a search to the minimum of a quadratic model, which is fitted to the evaluated points
// around x, within a given distance and inside a region.
//
// The quadratic approximates f^2 if f^2 is fitted at least as well as f, as around the minimum of a
// sum of absolute residuals. Otherwise, and if values are negative, it approximates f. In a ball
// its minimum is that of  m(s) + mu/2 |s|^2  (quadratic_model.h). If linear constraints cut off the
// ball, the same convex function is minimized inside them (quadratic_program.h), and the step is
// shortened to the given distance.
#pragma once

#include <optional>

#include "optimization/direct_search/quadratic_model.h"
#include "optimization/problem/feasible_region.h"

namespace latsch {

/// Returns the step from x; nullopt if there are too few samples. If the region has no linear
/// constraints, the step may lead beyond the bounds.
std::optional<Eigen::VectorXd> model_step(const SharedHistory<Sample>& samples,
                                          const FeasibleRegion& region,
                                          const Eigen::VectorXd& x,
                                          double reach);

}  // namespace latsch
