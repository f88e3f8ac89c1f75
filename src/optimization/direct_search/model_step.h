// SPDX-License-Identifier: Apache-2.0
// The step of a search to the least value, within reach and inside a region, of a quadratic
// through the evaluated points around x.
//
// The quadratic is one of f, or of f^2 where that is fitted better or as well, as it is around the
// minimum of a sum of absolute residuals; where values are negative it is one of f. In a ball its
// minimum is that of  m(s) + mu/2 |s|^2  (quadratic_model.h). Where linear constraints cut the ball
// off, that same convex function is made least among them (quadratic_program.h), and the step cut
// at the reach.
#pragma once

#include <optional>

#include "optimization/direct_search/quadratic_model.h"
#include "optimization/problem/feasible_region.h"

namespace latsch {

/// nullopt with too few samples. In a cube the step may lead over the bounds.
std::optional<Eigen::VectorXd> model_step(const SharedHistory<Sample>& samples,
                                          const FeasibleRegion& region,
                                          const Eigen::VectorXd& x,
                                          double reach);

}  // namespace latsch
