// SPDX-License-Identifier: Apache-2.0
// The frequency band that the recorded motion of posts contains in a mode: the lines at which the
// velocity of the posts has at least a ten-thousandth of its largest power. Outside of the band, a
// response shows only rounding, noise or harmonics. The velocity is used because the heights of
// roads and sweeps fall with frequency.
#pragma once

#include <optional>

#include "experiment/rigs/car/four_post_rig.h"

namespace latsch::experiment {

struct HeldBand {
  double from, to;  // Hz
};

/// Returns the band. Powers are means over `width`, Hz, on either side of a line. Returns nullopt
/// if the posts do not move in this mode.
std::optional<HeldBand> held_band(const FourPostTest& test, PostMode mode, double width);

/// Returns the share of the power of the posts' velocity in this mode above a frequency, Hz.
double share_above(const FourPostTest& test, PostMode mode, double frequency);

}  // namespace latsch::experiment
