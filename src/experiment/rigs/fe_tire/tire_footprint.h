// SPDX-License-Identifier: Apache-2.0
// Footprints of the finite-element tire, with their slopes.
#pragma once

#include <vector>

#include "base/result.h"
#include "experiment/rigs/fe_tire/channel_slopes.h"
#include "experiment/rigs/footprint_rig.h"
#include "models/fe_tire/analysis/fe_tire.h"
#include "models/fe_tire/slopes/tire_slopes.h"

namespace latsch::experiment {

/// In the states of a test, in their order; deflections are ascending.
struct StandingTire {
  fe_tire::Inflated inflated;
  std::vector<fe_tire::TireState> states;
};
Result<StandingTire> stand_in_states(fe_tire::FeTire& tire,
                                     double pressure,
                                     const fe_tire::Ground& ground,
                                     const FootprintTest& test);

std::vector<StandingFootprint> footprints(fe_tire::FeTire& tire, const StandingTire& standing);

/// Of all channels but pressures on sensors, upright and without friction: a load or a deflection
/// is held while a number moves. `of`: the footprints there.
Result<ChannelSlopes> footprint_slopes(const FootprintTest& test,
                                       const StandingTire& standing,
                                       const std::vector<StandingFootprint>& of,
                                       fe_tire::TireSlopes& slopes);

}  // namespace latsch::experiment
