// SPDX-License-Identifier: Apache-2.0
// Phrases that several tests use in their descriptions.
#pragma once

#include <string>
#include <vector>

#include "experiment/language/test.h"
#include "experiment/rigs/hub_frame.h"

namespace latsch::experiment {

/// Returns an angle such as "2 deg".
std::string degrees(double angle);
/// Returns ", camber 2 deg"; "" for no camber.
std::string cambered(double camber);
/// Returns the channels of forces and moments for a test that records them in these frames
/// (rigs/hub_frame.h).
std::vector<ChannelInfo> force_channels(const std::vector<AxisFrame>& frames);

}  // namespace latsch::experiment
