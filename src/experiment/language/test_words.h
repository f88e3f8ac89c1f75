// SPDX-License-Identifier: Apache-2.0
// Words that tests share when they say what they are.
#pragma once

#include <string>
#include <vector>

#include "experiment/language/test.h"
#include "experiment/rigs/hub_frame.h"

namespace latsch::experiment {

/// "2 deg"
std::string degrees(double angle);
/// ", camber 2 deg"; empty for none.
std::string cambered(double camber);
/// Forces and moments of a test that records them in these frames (rigs/hub_frame.h).
std::vector<ChannelInfo> force_channels(const std::vector<AxisFrame>& frames);

}  // namespace latsch::experiment
