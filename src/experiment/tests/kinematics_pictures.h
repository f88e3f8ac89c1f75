// SPDX-License-Identifier: Apache-2.0
// What a page shows of a suspension's kinematics: its curves by travel, roll or rack, in degrees
// and millimeters.
#pragma once

#include "experiment/language/test.h"
#include "measurement/channels.h"

namespace latsch::experiment {

/// Of the channels that are there, those that belong together in one frame; they have the signs of
/// that convention already, captions and axes say them.
Test::Details kinematics_details(const Channels& channels, suspension::SignView view);

}  // namespace latsch::experiment
