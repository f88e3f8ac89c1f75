// SPDX-License-Identifier: Apache-2.0
// Writes the results of `latsch process` as tables of separated values with units in the headers,
// which Latsch can read again: passages, averages, spectra, band levels, the hammer's response, the
// filter, the table of the cases.
#pragma once

#include <filesystem>
#include <vector>

#include "correlation/rig_data/rig_processing.h"

namespace latsch::correlation {

/// Writes the tables into the folder, which is created if necessary. Returns the files in the order
/// in which they were written.
std::vector<std::filesystem::path> write_rig_tables(const RigFile& rig,
                                                    const RigResults& results,
                                                    const std::filesystem::path& folder);

/// Returns the part of a file name for a run at a speed: "c_dummy_60kph".
std::string plateau_name(const std::string& run, double speed);

}  // namespace latsch::correlation
