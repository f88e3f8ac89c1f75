// SPDX-License-Identifier: Apache-2.0
// Derivatives of a ring's state by one number, stored in a RingState whose motion is not used.
#pragma once

#include "models/ring_tire/ring/ring_state.h"

namespace latsch::ring_tire {

/// Returns the state with the given number increased by `by`. The blocks are those of the state.
RingState along(const RingState& state, const RingState& slope, double by);

/// Computes the derivatives of the memory of sidewall, tread and sections from a difference `over`
/// of the number; the nodes' derivatives in `to` are not changed. Returns false if patches differ.
bool find_memory_slope(const RingState& more, const RingState& less, double over, RingState& to);

}  // namespace latsch::ring_tire
