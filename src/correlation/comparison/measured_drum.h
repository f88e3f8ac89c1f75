// SPDX-License-Identifier: Apache-2.0
// The measured forces of a drum test, checked before tires are compared with them.
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "correlation/laboratory/measurement.h"
#include "measurement/axes.h"

namespace latsch::correlation {

struct MeasuredDrum {
  std::vector<std::vector<double>> forces;  // N or N m, [channel][time], linear between samples
  double highest = 0.0;                     // Hz, half the rate of the recording
};

/// Returns the channels of a recording at the times of a test, s. `frame` is that of the test's
/// forces, `load` its load in N, if it has one. Throws InputError that names file and line if the
/// recording lacks a channel, has it in another frame, has no samples, does not cover the times, or
/// misses samples, if its time does not rise, and if a channel is constant, cannot be that of a
/// tire, or is in another unit than its file states.
MeasuredDrum measured_drum(const Measurement& recording,
                           const std::vector<std::string>& channels,
                           const std::vector<double>& times,
                           AxisFrame frame,
                           std::optional<double> load);

}  // namespace latsch::correlation
