// SPDX-License-Identifier: Apache-2.0
// Spectra of recordings that a comparison of models compares, with the checks that a recording has
// what its spectra need.
#pragma once

#include <string>
#include <vector>

#include "correlation/comparison/model_comparison_file.h"
#include "measurement/band_level.h"
#include "measurement/channels.h"
#include "numerics/signals/welch.h"

namespace latsch::correlation {

/// Noise of a measured line: its density, and the number of spectra averaged.
struct LineNoise {
  double density = 0.0;
  double segments = 1.0;

  /// Returns ln(value / (S + density)) for the measured value of a line with density S at z
  /// standard deviations of the equivalent normal variable.
  double log_quantile(double S, double z) const;
};

/// Returns the reference's recording after the low-pass filter of the file. Filters forward only,
/// starting from the steady state of the first 20 ms, so that later samples do not affect earlier
/// ones.
Channels low_passed(const ModelComparisonFile& file, const Channels& recording);

/// Returns the selected samples of a channel. `whose` names the recording in the InputError that
/// states that the channel is missing.
std::vector<double> selected_samples(const ModelComparisonFile& file,
                                     const Channels& channels,
                                     const std::string& name,
                                     const std::string& whose);

/// Returns the densities of the compared channels, unit^2/Hz, in the order of the file. Throws
/// InputError if the recording is uneven in time, too short, or too slow for a band.
std::vector<numerics::Density> densities_of(const ModelComparisonFile& file,
                                            const Channels& channels,
                                            const std::string& whose);

/// Throws InputError if a channel of the reference has no power in a band, because nothing can then
/// be compared with it.
void check_power(const ModelComparisonFile& file, const std::vector<numerics::Density>& reference);

/// Returns the white noise that the file states, by compared channel.
std::vector<LineNoise> noise_of(const ModelComparisonFile& file, const Channels& recording);

/// Returns RMS(a - b) / RMS(b) over the lines of the band.
double psd_distance(const numerics::Density& a, const numerics::Density& b, FrequencyBand band);

/// True if a line of this frequency (Hz) belongs to the band.
bool is_in(double frequency, FrequencyBand band);

}  // namespace latsch::correlation
