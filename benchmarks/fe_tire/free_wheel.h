// SPDX-License-Identifier: Apache-2.0
// A finite-element tire that rolls freely under a load, for the benchmarks of rolling.
#pragma once

#include "models/fe_tire/analysis/fe_tire.h"
#include "models/fe_tire/description/tire_description.h"
#include "models/fe_tire/rolling/rolling_tire.h"

namespace latsch::benchmarks {

/// A tire that rolls, with its free wheel under a load.
struct FreeWheel {
  fe_tire::FeTire tire;
  fe_tire::Inflated inflated;
  fe_tire::RollingTire rolling;
  fe_tire::RollingState state;

  /// Presses the tire and finds the free wheel, with the history of rubbers and cords that have
  /// terms. `load`: N; `speed`: m/s; `friction`: coefficient. Throws the reason if a state is not
  /// found.
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
