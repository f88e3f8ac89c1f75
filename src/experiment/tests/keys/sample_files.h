// SPDX-License-Identifier: Apache-2.0
// The files that samples of tests name, and recordings for samples that take their conditions from
// a measurement.
#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "experiment/language/test.h"
#include "measurement/channels.h"

namespace latsch::experiment {

struct SampleFile {
  std::string name, text;
};
const std::vector<SampleFile>& sample_files();

/// Returns a recording of the conditions: every channel near a usual value times `scale`, in
/// `samples` samples.
Channels sample_recording(const std::vector<MeasuredCondition>& conditions,
                          double scale = 1.0,
                          int samples = 12);

/// Returns the source of a sample of a test: the folder of the sample files, and one recording for
/// every measurement.
TestSource source_of_samples(const std::filesystem::path& folder,
                             double scale = 1.0,
                             int samples = 12);

}  // namespace latsch::experiment
