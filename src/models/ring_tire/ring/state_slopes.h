// SPDX-License-Identifier: Apache-2.0
// Derivatives of a ring's state by one number, which stand in a RingState themselves; its motion
// means nothing then.
#pragma once

#include "models/ring_tire/ring/ring_state.h"

namespace latsch::ring_tire {

/// The state where that number is `by` more. Blocks: those of the state.
RingState along(const RingState& state, const RingState& slope, double by);

/// What sidewall, tread and sections remember, by a difference of the number of `over`; the nodes'
/// own stay in `to`. False where patches differ.
bool find_memory_slope(const RingState& more, const RingState& less, double over, RingState& to);

}  // namespace latsch::ring_tire
