// SPDX-License-Identifier: Apache-2.0
// The lag of a rolling tire behind its slip: the wheel of a flat track (flat_track.h) gets a small
// slip ratio or slip angle, and the force approaches its limit over the relaxation length σ, m,
//
//   σ = ∫ (1 - F(x)/F(∞)) dx
//
// with the distance x, m, and F, half the difference of the forces at the slip and at its negative.
// For a force proportional to 1 - exp(-x/σ) it is the length σ of this formula. In a sweep whose
// slip changes by s' per meter, the force at any moment belongs to a slip that is smaller by s' σ,
// as long as slips are small.
#pragma once

#include <string>

#include "base/result.h"
#include "experiment/rigs/slip/flat_track.h"
#include "models/tire/tire.h"

namespace latsch::experiment {

struct SlipRelaxation {
  double length = 0.0;  // m, σ
  /// slope of force over slip ratio, N, or over slip angle, N/rad; either sign
  double stiffness = 0.0;
};

/// Measures the relaxation length at the speed, load, camber and step of a sweep, from Fy if the
/// sweep varies the slip angle, otherwise from Fx.
Result<SlipRelaxation> relaxation(Tire& tire, const SlipSweep& sweep);

/// Returns a sentence that says how far the forces of a sweep lag behind and which duration, s,
/// would be long enough; empty if the lag at small slips is less than 5 % of `most`, the largest
/// force of the sweep, N.
std::string lag_in_words(const SlipRelaxation& relaxation, const SlipSweep& sweep, double most);

}  // namespace latsch::experiment
