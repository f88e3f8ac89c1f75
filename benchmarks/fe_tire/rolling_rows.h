// SPDX-License-Identifier: Apache-2.0
// Rows of the benchmark `rolling` (rolling_bench.cpp): rings that roll on the ground
// (rolling_ring_rows.cpp) and tires that do (rolling_tire_rows.cpp).
#pragma once

#include "options.h"
#include "table.h"

namespace latsch::benchmarks {

/// Carter's line contact and the brush model on rings that RollingTire rolls (rolling_rings.h).
void roll_rings(const Options& options, Table& table);

/// Tires with friction that slide as a whole, and tires without friction.
void roll_tires(const Options& options, Table& table);

}  // namespace latsch::benchmarks
