// SPDX-License-Identifier: Apache-2.0
// Rules for the step and the sample step of a run in time: what passes within a step is not seen by
// the simulation, and what is faster than half the rate of the samples appears in the record at
// another frequency.
#pragma once

#include <string>

#include "base/document.h"

namespace latsch::experiment {

/// Fewest samples of a period of the fastest motion that drives a run. A motion that is straight
/// between ten samples has its amplitude to 3 %, between twelve to 2 %.
constexpr double kSamplesOfPeriod = 12.0;
/// Frequency, Hz, up to which a tire and the wheel on it vibrate strongly after an obstacle.
constexpr double kTireVibrates = 100.0;
/// Length of a footprint, m: an obstacle is below a tire for at least this distance.
constexpr double kFootprint = 0.1;

/// Throws InputError if the record has too few samples of a period of `highest`, Hz. `key` is the
/// key of that frequency, to which the message gives a way out.
void refuse_coarse_samples(const Node& test, const char* key, double highest, double sample_step);

/// Returns a sentence if the samples of a tire that rolls over an obstacle at this speed, m/s, do
/// not hold its vibrations, or if it moves by more than a footprint between two of them; else an
/// empty text.
std::string note_on_samples(double sample_step, double speed);

}  // namespace latsch::experiment
