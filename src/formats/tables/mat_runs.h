// SPDX-License-Identifier: Apache-2.0
// Finds recordings in the structs of a MAT file, and constants of the file.
//
//   run1.Fz, run1.alpha, run2.Fz ...   two recordings; "run1" is the path of the first one
//   runs(2).Fz.data                    the second element "runs(2)" of an array of structs
//   P = 82.7, in kPa                   a constant: it has the same value in all samples
#pragma once

#include <map>
#include <set>
#include <string>
#include <vector>

#include "formats/tables/mat_file.h"

namespace latsch::formats {

/// Returns the paths of structs that contain at least two vectors of known channels, in the order
/// of the file; the path "" means the file itself.
std::vector<std::string> runs_in(const MatFile& file);

/// Returns the members of a struct with their names in it: "Fz" for "run1.Fz". Throws InputError if
/// there is no such struct; the message lists the structs of the file.
MatFile run_of(const MatFile& file, const std::string& path);

/// Turns single numbers into vectors of equal values with as many samples as the other vectors of
/// the file, and returns their names. This is done for every number that is a known channel with a
/// unit or whose name is in `units`. Nothing is done for a number if the file has a vector of the
/// same channel, or for any number if the vectors of known channels differ in length.
std::set<std::string> spread_constants(const std::map<std::string, std::string>& units,
                                       MatFile& file);

}  // namespace latsch::formats
