// SPDX-License-Identifier: Apache-2.0
// Rows of bench_ring_speed that check the balance of momentum and energy of a rolling ring.
#pragma once

#include "table.h"

namespace latsch::benchmarks {

/// Adds the balance of momentum and angular momentum of a wheel with camber, steer and slip that
/// rolls over a cleat.
void momentum_row(Table& table);
/// Adds the energy balance over a cleat without friction and damping: the drift relative to the
/// work of the contact, and the order of the drift in the time step.
void energy_rows(Table& table);

}  // namespace latsch::benchmarks
