// SPDX-License-Identifier: Apache-2.0
// Chooses another start if the start of a method failed: a point on the line from it to the middle
// of the region.
#pragma once

#include <optional>

#include "optimization/problem/feasible_region.h"

namespace latsch {

struct StartAttempt {
  Eigen::VectorXd u;
  int attempts = 0;  // number of starts tried after the initial one
};

/// Returns the next start after a failed one. It lies a quarter, half, three quarters or all of the
/// distance from the initial point to the middle of the region, and at least `distance` away from
/// the failed start. Returns nullopt if all of these were tried.
std::optional<StartAttempt> start_toward_middle(const DesignSpace& space,
                                                const FeasibleRegion& region,
                                                const StartAttempt& failed,
                                                double distance);

}  // namespace latsch
