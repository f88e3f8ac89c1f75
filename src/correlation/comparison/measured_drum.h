// SPDX-License-Identifier: Apache-2.0
// The measured forces of a drum test, checked before tires are compared with them.
#pragma once

#include <filesystem>
#include <string>
#include <vector>

namespace latsch::correlation {

struct MeasuredDrum {
  std::vector<std::vector<double>> forces;  // N or N m, [channel][time], linear between samples
  double highest = 0.0;                     // Hz, half the rate of the recording
};

/// Reads the channels of a table and interpolates them at the times of a test, s. Throws InputError
/// that names the file if the table has no samples, does not cover the times, or misses samples, if
/// its time does not rise, and if a channel is constant or cannot be that of a tire.
MeasuredDrum measured_drum(const std::filesystem::path& file,
                           const std::vector<std::string>& channels,
                           const std::vector<double>& times);

}  // namespace latsch::correlation
