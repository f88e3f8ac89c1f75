// SPDX-License-Identifier: Apache-2.0
// Pictures of the test "rolling_response": forces and relaxation lengths over the frequency.
#pragma once

#include "experiment/language/test.h"

namespace latsch::experiment {

/// Returns a picture of the size and one of the phase of every force along the ground and moment
/// Mz by each slip, and one of the relaxation lengths, with a line for each state
/// (rigs/fe_rolling/rolling_response_rig.h has the channels).
Test::Details rolling_response_details(const Channels& response);

}  // namespace latsch::experiment
