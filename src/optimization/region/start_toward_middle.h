// SPDX-License-Identifier: Apache-2.0
// Where a method begins whose start failed: on the way from there to the middle of the region.
#pragma once

#include <optional>

#include "optimization/problem/feasible_region.h"

namespace latsch {

struct StartAttempt {
  Eigen::VectorXd u;
  int attempts = 0;  // how many places were tried after the initial one
};

/// The next place after one that failed, a quarter, half, three quarters or all of the way from the
/// initial point to the middle of the region, farther than `distance` from the last; nullopt: all
/// were tried.
std::optional<StartAttempt> start_toward_middle(const DesignSpace& space,
                                                const FeasibleRegion& region,
                                                const StartAttempt& failed,
                                                double distance);

}  // namespace latsch
