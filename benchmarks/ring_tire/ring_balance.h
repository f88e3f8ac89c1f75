// SPDX-License-Identifier: Apache-2.0
// Rows of ring_speed: what a rolling ring takes from the rim, the road and its own motion adds up.
#pragma once

#include "table.h"

namespace latsch::benchmarks {

/// Momentum and angular momentum of a wheel with camber, steer and slip over a cleat.
void momentum_row(Table& table);
/// Energy over a cleat without friction and damping: its drift beside the contact's work, and the
/// order of that in the step.
void energy_rows(Table& table);

}  // namespace latsch::benchmarks
