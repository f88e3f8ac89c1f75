// SPDX-License-Identifier: Apache-2.0
// Drum rig for the finite-element tire: over a cleat with the axle held at one height and a wheel
// that spins freely (passage/rolling_transient.h). Keys and channels are those of drum_rig.h.
//
// The tire is pressed on the drum at rest, without friction, under the load or to the deflection of
// the test. Then it rolls freely at the height found, and this steady state is the start: there is
// no run-in. A tire of revolution does not know how far its wheel has turned, so one passage is the
// mean of all.
//
// The cleat is felt through means of the tread as wide as an element (grip/passing_bar.h), and
// through wider ones if it is so high that its flanks would be steeper than 45 degrees.
//
// A tire that its file reduces is reduced about the steady state before the cleat.
#pragma once

#include <functional>
#include <string>
#include <vector>

#include "experiment/rigs/drum_rig.h"
#include "experiment/rigs/fe_tire/tire_rig.h"

namespace latsch::experiment {

/// Passes samples to `tell` in order, some at a time, as soon as they are known, and adds how far a
/// reduced tire is from the full one to `remarks`. A Failure says what is out of range, or when the
/// tire has no state any more.
Status cross_cleat(TireRig& rig,
                   const DrumTest& test,
                   const std::function<void(const Channels&)>& tell,
                   std::vector<std::string>& remarks);
/// Returns all samples.
Result<Channels> cross_cleat(TireRig& rig, const DrumTest& test, std::vector<std::string>& remarks);

/// Returns a sentence for everything that the tire assumes or does not use of the test.
std::vector<std::string> remarks_on_cleat(const TireRig& rig, const DrumTest& test);

}  // namespace latsch::experiment
