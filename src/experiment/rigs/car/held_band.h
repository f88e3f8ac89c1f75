// SPDX-License-Identifier: Apache-2.0
// The frequency band that a record of posts contains in a mode: the lines at which the velocity of
// the posts has at least a ten-thousandth of its greatest power. Outside the band, a response shows
// only rounding, noise or harmonics. Velocity is used because the heights of roads and sweeps fall
// with frequency.
#pragma once

#include <optional>

#include "experiment/rigs/car/four_post_rig.h"

namespace latsch::experiment {

struct HeldBand {
  double from, to;  // Hz
};

/// `width`, Hz: powers are means over this width to either side. Returns nullopt if the posts do
/// not move in this mode.
std::optional<HeldBand> held_band(const FourPostTest& test, PostMode mode, double width);

/// Returns the share of the power of the posts' velocity in this mode above a frequency, Hz.
double share_above(const FourPostTest& test, PostMode mode, double frequency);

}  // namespace latsch::experiment
