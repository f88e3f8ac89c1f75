// SPDX-License-Identifier: Apache-2.0
// Rows of the benchmark `rolling` (rolling_bench.cpp): rings that roll on the ground
// (rolling_ring_rows.cpp) and tires that do (rolling_tire_rows.cpp).
#pragma once

#include "models/fe_tire/analysis/fe_tire.h"
#include "models/fe_tire/description/tire_description.h"
#include "models/fe_tire/rolling/rolling_tire.h"
#include "options.h"
#include "table.h"

namespace latsch::benchmarks {

/// Carter's line contact and the brush model on rings that RollingTire rolls (rolling_rings.h).
void roll_rings(const Options& options, Table& table);

/// Tires with friction that slide as a whole, and tires without friction.
void roll_tires(const Options& options, Table& table);

/// A tire that rolls, with its free wheel under a load.
struct FreeWheel {
  fe_tire::FeTire tire;
  fe_tire::Inflated inflated;
  fe_tire::RollingTire rolling;
  fe_tire::RollingState state;

  /// Presses the tire and finds the free wheel. `load`: N; `speed`: m/s; `friction`: coefficient.
  FreeWheel(const fe_tire::TireDescription& of,
            const fe_tire::MeshRefinement& mesh,
            double load,
            double speed,
            double friction);
  /// The free wheel's case at a slip, a slip angle, a camber (rad) and a turn slip (1/m).
  fe_tire::RollingCase at(double kappa,
                          double alpha,
                          double camber = 0.0,
                          double turn_slip = 0.0) const;
};

}  // namespace latsch::benchmarks
