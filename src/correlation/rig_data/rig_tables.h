// SPDX-License-Identifier: Apache-2.0
// What `latsch process` found as separated values, units in the headers, every file readable by
// latsch again: passages, averages, spectra, band levels, the hammer's response, the filter, the
// table of the cases.
#pragma once

#include <filesystem>
#include <vector>

#include "correlation/rig_data/rig_processing.h"

namespace latsch::correlation {

/// Writes into the folder, which is made where it is missing. The files, in the order written.
std::vector<std::filesystem::path> write_rig_tables(const RigFile& rig,
                                                    const RigResults& results,
                                                    const std::filesystem::path& folder);

/// "c_dummy_60kph": a run at a speed in file names.
std::string plateau_name(const std::string& run, double speed);

}  // namespace latsch::correlation
