// SPDX-License-Identifier: Apache-2.0
// Footprints of the finite-element tire, with their slopes.
//
// A node's pressure is a mean weighted by its hat function (T.1); for the share of the surface that
// the node represents, of length L, only the force is known. Spread evenly over that share, the
// force is too close to the node; spread by the hat function, which extends to the neighbors, it is
// too far from the node if these are not in contact. Between both lies the even distribution
// blurred over b,
//   b = L / sqrt(2),   its second moment (L^2 + b^2) / 12,                                    (P.1)
// which is midway between the even distribution, L^2 / 12, and the hat function, L^2 / 6, as half
// the sag is what counts in a mean in (T.2). This applies along the road and across it.
#pragma once

#include <vector>

#include "base/result.h"
#include "experiment/rigs/fe_tire/channel_slopes.h"
#include "experiment/rigs/footprint_rig.h"
#include "models/fe_tire/analysis/fe_tire.h"
#include "models/fe_tire/slopes/tire_slopes.h"

namespace latsch::experiment {

/// Returns each contact point as the rectangle it represents. `friction` is that of the ground.
Footprint footprint_of(const fe_tire::Standing& standing, double friction);

/// The tire in the states of a test, in their order; deflections are ascending.
struct StandingTire {
  fe_tire::Inflated inflated;
  std::vector<fe_tire::TireState> states;
};
Result<StandingTire> stand_in_states(fe_tire::FeTire& tire,
                                     double pressure,
                                     const fe_tire::Ground& ground,
                                     const FootprintTest& test);

std::vector<StandingFootprint> footprints(fe_tire::FeTire& tire, const StandingTire& standing);

/// Slopes of all channels except pressures on sensors, upright and without friction; a load or a
/// deflection is held constant while a number varies. `of` are the footprints in these states.
Result<ChannelSlopes> footprint_slopes(const FootprintTest& test,
                                       const StandingTire& standing,
                                       const std::vector<StandingFootprint>& of,
                                       fe_tire::TireSlopes& slopes);

}  // namespace latsch::experiment
