// SPDX-License-Identifier: Apache-2.0
// Warnings about the run of a car, a sentence each: tires that left the road or their posts, lines
// at which the coherence of a four-post run is low.
#pragma once

#include <functional>
#include <string>
#include <vector>

#include "measurement/channels.h"

namespace latsch::experiment {

/// Names the tires whose load fell to zero, and the times. `at_time` words a time: "8.2 s, at 6.1
/// Hz of the sweep".
std::vector<std::string> notes_of_lift(const Channels& record,
                                       const std::function<std::string(double)>& at_time);

/// Says for each tire of a car on a road from when to when it is off the road. `record` has samples
/// every `sample_step`, s.
std::vector<std::string> lifts_of(const Channels& record, double sample_step);

/// Names the sensors whose coherence is below 0.9, and at how many lines.
std::vector<std::string> notes_of_coherence(const Channels& over_frequency);

}  // namespace latsch::experiment
