// SPDX-License-Identifier: Apache-2.0
// Spectral densities as people compare them: the level of a band in dB, the distance of two spectra
// in dB.
//
//   L = 10 log10( integral of S over the band / ref^2 )                        dB re ref
//   d = sqrt( mean over the band of (10 log10 S_1/S_2)^2 )                     log-spectral
//   distance
#pragma once

#include <vector>

#include "measurement/rig_response_fit.h"
#include "numerics/signals/welch.h"

namespace latsch {

/// Third-octave bands (base 10, IEC 61260-1) whose centers lie in the range.
std::vector<FrequencyBand> third_octave_bands(FrequencyBand range);

/// Mean square of the band: each line counts for the part of its bin inside.
double band_power(const numerics::Density& density, FrequencyBand band);
/// dB re `reference`; -infinity where there is no power.
double band_level(const numerics::Density& density, FrequencyBand band, double reference = 1.0);

/// dB; over the lines in the band where both densities are positive.
double log_spectral_distance(const numerics::Density& a,
                             const numerics::Density& b,
                             FrequencyBand band);

}  // namespace latsch
