// SPDX-License-Identifier: Apache-2.0
// The frequencies that a record of posts holds in a mode: there the posts' velocity has at least a
// ten-thousandth of the power it has at its strongest line. Beyond them a response is that of
// rounding, of noise or of harmonics. Velocities, since the heights of roads and of sweeps fall
// with the frequency.
#pragma once

#include <optional>

#include "experiment/rigs/car/four_post_rig.h"

namespace latsch::experiment {

struct HeldBand {
  double from, to;  // Hz
};

/// `width`, Hz: powers are means over as much to either side. None: the posts do not move so.
std::optional<HeldBand> held_band(const FourPostTest& test, PostMode mode, double width);

}  // namespace latsch::experiment
