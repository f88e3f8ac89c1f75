// SPDX-License-Identifier: Apache-2.0
// Common measures of spectral densities: the level of a band in dB and the distance of two spectra
// in dB.
//
//   L = 10 log10( integral of S over the band / ref^2 )              dB re ref
//   d = sqrt( mean over the band of (10 log10 S_1/S_2)^2 )           log-spectral distance
#pragma once

#include <vector>

#include "measurement/rig_response_fit.h"
#include "numerics/signals/welch.h"

namespace latsch {

/// Returns the third-octave bands (base 10, IEC 61260-1) whose centers lie in the range.
std::vector<FrequencyBand> third_octave_bands(FrequencyBand range);

/// Returns the mean square in the band: each line counts in proportion to the part of its bin
/// inside the band.
double band_power(const numerics::Density& density, FrequencyBand band);
/// Returns the level in dB relative to `reference`; -infinity if there is no power.
double band_level(const numerics::Density& density, FrequencyBand band, double reference = 1.0);

/// Returns the log-spectral distance in dB over those lines in the band at which both densities are
/// positive.
double log_spectral_distance(const numerics::Density& a,
                             const numerics::Density& b,
                             FrequencyBand band);

}  // namespace latsch
