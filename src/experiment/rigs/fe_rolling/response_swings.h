// SPDX-License-Identifier: Apache-2.0
// Sentences that say how large a slip may swing before the response of a rolling tire
// (rolling_response_rig.h) no longer describes its forces.
//
// The response has the derivatives of a steady state in which points keep sticking or sliding. The
// steady force over a slip is smooth only as long as no point of the tread changes between the two.
// A point that slides carries mu times its pressure, so with a large mu a few points at the rear of
// the patch can change the slope of the force much, and over a small part of the slip alone. The
// chord between two steady states shows it.
#pragma once

#include <string>
#include <vector>

#include "experiment/rigs/fe_rolling/rolling_response_rig.h"

namespace latsch::experiment {

/// Difference of a response at 0 Hz from the chord of steady states, relative to the chord, from
/// which it is told.
inline constexpr double kToldDifference = 0.05;

/// Compares the responses at 0 Hz to the test's slips about one state with the chords of steady
/// states over the swings of ResponseSlip to both sides. Returns a sentence for each slip whose
/// main force differs by more than kToldDifference, which says over which smaller swing it does
/// not. `number` counts states from 1.
std::vector<std::string> swings_in_words(TireRig& rig,
                                         const RollingResponseTest& test,
                                         const RolledState& rolled,
                                         const std::vector<fe_tire::SlipResponse>& at_rest,
                                         std::size_t number);

}  // namespace latsch::experiment
