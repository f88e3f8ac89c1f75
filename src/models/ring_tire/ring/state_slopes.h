// SPDX-License-Identifier: Apache-2.0
// Derivatives of a ring's state with respect to one parameter. They are stored in a RingState,
// whose motion is not used.
#pragma once

#include "models/ring_tire/ring/ring_state.h"

namespace latsch::ring_tire {

/// Returns the state after an increase of the parameter by `by`. The set of touching blocks is that
/// of `state`.
RingState along(const RingState& state, const RingState& slope, double by);

/// Computes the derivatives of the memories of sidewall, tread and sections from two states, whose
/// parameter differs by `over`. The derivatives of the nodes in `to` are not changed. Returns false
/// if the contact patches of both states contain different blocks.
bool find_memory_slope(const RingState& more, const RingState& less, double over, RingState& to);

}  // namespace latsch::ring_tire
