// SPDX-License-Identifier: Apache-2.0
// Writes a measurement computed by a model (a twin): the file keeps its content except the columns
// that the model computes, which are written with the file's names, units and signs.
//
// The processing of the recording has to be inverted for that. Axes are converted back, and frames
// by the gamma and loaded_radius of the file. A shift in time leaves forces unchanged. A selection,
// a filter or a subtracted zero cannot be inverted.
#pragma once

#include <filesystem>
#include <map>
#include <string>
#include <vector>

#include "correlation/laboratory/measurement.h"

namespace latsch::correlation {

/// Writes `values` of channels, in SI and iso, one for each sample; `comment` becomes the first
/// line. If in_frame has converted forces, all forces of the file are written, so `values` must
/// contain all channels that the conversion needs. Returns the file. Throws InputError if a step
/// cannot be inverted or if the measurement is not a single .csv file.
std::filesystem::path write_twin(const Measurement& measurement,
                                 const std::map<std::string, std::vector<double>>& values,
                                 const std::string& comment);

}  // namespace latsch::correlation
