// SPDX-License-Identifier: Apache-2.0
// A measurement written from a model (a twin): the file stays what it is, but for the columns that
// the model answers, which come in the file's names, units and signs.
//
// What has been done to a recording has to be undone for that: axes are, and frames, by the gamma
// and loaded_radius of the file; a shift leaves forces as they are, a selection, a filter or a zero
// cannot.
#pragma once

#include <filesystem>
#include <map>
#include <string>
#include <vector>

#include "correlation/laboratory/measurement.h"

namespace latsch::correlation {

/// `values` of channels, in SI and iso, one a sample; `comment` becomes the first line. Of forces
/// that in_frame has turned all are written that the file has, so `values` has to hold what they
/// take. Returns the file. Throws InputError where a step cannot be undone, or the file is no
/// single .csv.
std::filesystem::path write_twin(const Measurement& measurement,
                                 const std::map<std::string, std::vector<double>>& values,
                                 const std::string& comment);

}  // namespace latsch::correlation
