// SPDX-License-Identifier: Apache-2.0
// Lag of a rolling tire behind its slip: the wheel of a flat track (flat_track.h) gets a small slip
// or slip angle, and the force approaches its limit over the relaxation length σ,
//
//   σ = ∫ (1 - F(x)/F(∞)) dx,  F: half the difference of the forces at the slip and its opposite
//
// which is the length of a force that approaches as 1 - exp(-x/σ). A sweep that changes the slip by
// s' per meter has at each place the force of the slip s' σ before, as long as slips are small.
#pragma once

#include <string>

#include "base/result.h"
#include "experiment/rigs/slip/flat_track.h"
#include "models/tire/tire.h"

namespace latsch::experiment {

struct SlipRelaxation {
  double length = 0.0;     // m, σ
  double stiffness = 0.0;  // N, force over slip; for a slip angle N/rad; of either sign
};

/// Measures the relaxation at the speed, load, camber and step of a sweep: in Fy if the sweep
/// steers, else in Fx.
Result<SlipRelaxation> relaxation(Tire& tire, const SlipSweep& sweep);

/// Says how far the forces of a sweep lag and which duration, s, would let the tire follow; empty
/// if the lag at small slips is less than 5 % of the greatest force `most`, N, of the sweep.
std::string lag_in_words(const SlipRelaxation& relaxation, const SlipSweep& sweep, double most);

}  // namespace latsch::experiment
