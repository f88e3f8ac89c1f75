// SPDX-License-Identifier: Apache-2.0
// Rows of ring_speed: the balance of a rolling ring with rim, road and its own motion.
#pragma once

#include "table.h"

namespace latsch::benchmarks {

/// Adds the balance of momentum and angular momentum of a wheel with camber, steer and slip over a
/// cleat.
void momentum_row(Table& table);
/// Adds the energy over a cleat without friction and damping: its drift compared with the contact's
/// work, and the order of the drift in the step.
void energy_rows(Table& table);

}  // namespace latsch::benchmarks
