// SPDX-License-Identifier: Apache-2.0
// Warnings about the run of a car, one sentence each: tires that left the road or their posts,
// lines at which the coherence of a four-post run is low.
#pragma once

#include <functional>
#include <string>
#include <vector>

#include "measurement/channels.h"

namespace latsch::experiment {

/// Returns sentences on the tires whose load fell to zero, with the times. `at_time` returns a time
/// in words: "8.2 s, at 6.1 Hz of the sweep".
std::vector<std::string> notes_of_lift(const Channels& record,
                                       const std::function<std::string(double)>& at_time);

/// Returns a sentence for each tire of a car on a road that left the road, with the times. `record`
/// has samples every `sample_step`, s.
std::vector<std::string> lifts_of(const Channels& record, double sample_step);

/// Returns sentences that name the sensors whose coherence is below 0.9, and the number of such
/// lines.
std::vector<std::string> notes_of_coherence(const Channels& over_frequency);

}  // namespace latsch::experiment
