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
/// Forces and moments among the channels are of this frame.
std::vector<ChannelInfo> framed(std::vector<ChannelInfo> channels, AxisFrame frame);

}  // namespace latsch::experiment
