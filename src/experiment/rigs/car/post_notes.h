// SPDX-License-Identifier: Apache-2.0
// Warnings about a four-post run, a sentence each: tires that left their posts, lines at
// which the coherence is low.
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

/// Names the sensors whose coherence is below 0.9, and at how many lines.
std::vector<std::string> notes_of_coherence(const Channels& over_frequency);

}  // namespace latsch::experiment
