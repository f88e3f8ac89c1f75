// SPDX-License-Identifier: Apache-2.0
// Draws a suspension's kinematics on a page: its curves over travel, roll or rack, in degrees and
// millimeters.
#pragma once

#include "experiment/language/test.h"
#include "measurement/channels.h"

namespace latsch::experiment {

/// Draws the existing channels that belong together in one plot; they are in the signs of that
/// convention already, which captions and axes name.
Test::Details kinematics_details(const Channels& channels, suspension::SignView view);

}  // namespace latsch::experiment
