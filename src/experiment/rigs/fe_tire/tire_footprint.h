// SPDX-License-Identifier: Apache-2.0
// Footprints of the finite-element tire, with their slopes.
//
// A node's pressure is a mean weighted by its hat (T.1), of which the share of the surface that it
// stands for, L long, knows only the force. Spread evenly over that share the force lies too close
// to the node, spread by the hat, which reaches to the neighbors, too far from it where these do
// not touch. Between them the even share that fades over b,
//   b = L / sqrt(2),   its second moment (L^2 + b^2) / 12,                                    (P.1)
// is midway between the even share, L^2 / 12, and the hat, L^2 / 6, as half the sag is what counts
// of a mean in (T.2). Along the road and across.
#pragma once

#include <vector>

#include "base/result.h"
#include "experiment/rigs/fe_tire/channel_slopes.h"
#include "experiment/rigs/footprint_rig.h"
#include "models/fe_tire/analysis/fe_tire.h"
#include "models/fe_tire/slopes/tire_slopes.h"

namespace latsch::experiment {

/// Each contact point as the rectangle it stands for. `friction`: of the ground.
Footprint footprint_of(const fe_tire::Standing& standing, double friction);

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
