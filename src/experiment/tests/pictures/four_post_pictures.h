// SPDX-License-Identifier: Apache-2.0
// Draws a car on four posts on a page: histories, densities, transfer functions.
#pragma once

#include "experiment/language/test.h"
#include "measurement/channels.h"

namespace latsch::experiment {

/// Draws the record of rigs/car/four_post_rig.h and its spectra (post_spectra.h).
Test::Details four_post_details(const Channels& record, const Channels& over_frequency);

}  // namespace latsch::experiment
