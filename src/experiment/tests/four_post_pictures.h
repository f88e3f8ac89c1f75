// SPDX-License-Identifier: Apache-2.0
// What a page shows of a car on four posts: histories, densities, transfer functions.
#pragma once

#include "experiment/language/test.h"
#include "measurement/channels.h"

namespace latsch::experiment {

/// Of what rigs/car/four_post_rig.h records, and the same over frequency (post_spectra.h).
Test::Details four_post_details(const Channels& record, const Channels& over_frequency);

}  // namespace latsch::experiment
