// SPDX-License-Identifier: Apache-2.0
// Rules for the time step and the sample step of a run in time: the simulation misses events that
// are shorter than a time step, and a motion faster than half the sampling rate appears in the
// record at another frequency.
#pragma once

#include <string>

#include "base/document.h"

namespace latsch::experiment {

/// Least number of samples in a period of the fastest motion that drives a run. Linear
/// interpolation between ten samples has an amplitude error of 3 %, between twelve of 2 %.
constexpr double kSamplesOfPeriod = 12.0;
/// frequency, Hz, up to which a tire with its wheel vibrates strongly after an obstacle
constexpr double kTireVibrates = 100.0;
/// Length of a footprint, m: an obstacle is below a tire for at least this distance.
constexpr double kFootprint = 0.1;

/// Throws InputError if the record has fewer than kSamplesOfPeriod samples in a period of the
/// frequency `highest`, Hz. `key` is the key of the test that states this frequency. The message
/// says which frequencies and which sample_step are permissible.
void refuse_coarse_samples(const Node& test, const char* key, double highest, double sample_step);

/// Returns a sentence if the samples of a tire that rolls over an obstacle at this speed, m/s, are
/// too far apart to represent its vibrations, or if the tire moves by more than the length of its
/// contact patch between two samples; otherwise an empty text.
std::string note_on_samples(double sample_step, double speed);

}  // namespace latsch::experiment
