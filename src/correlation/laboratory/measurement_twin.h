// SPDX-License-Identifier: Apache-2.0
// Writes a measurement from a model (a twin): the file keeps its content except the columns that
// the model computes, which are written in the file's names, units and signs.
//
// Processing of the recording has to be undone for that. Axes are undone, and frames by the gamma
// and loaded_radius of the file. A shift leaves forces as they are. A selection, a filter or a zero
// cannot be undone.
#pragma once

#include <filesystem>
#include <map>
#include <string>
#include <vector>

#include "correlation/laboratory/measurement.h"

namespace latsch::correlation {

/// Writes `values` of channels, in SI and iso, one for each sample; `comment` becomes the first
/// line. All forces that in_frame has turned are written if the file has them, so `values` must
/// hold all channels that the turn needs. Returns the file. Throws InputError if a step cannot be
/// undone, or the measurement is no single .csv file.
std::filesystem::path write_twin(const Measurement& measurement,
                                 const std::map<std::string, std::vector<double>>& values,
                                 const std::string& comment);

}  // namespace latsch::correlation
