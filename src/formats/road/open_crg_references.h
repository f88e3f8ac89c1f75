// SPDX-License-Identifier: Apache-2.0
// Resolves the references of OpenCRG files to other files: $ROAD_CRG_FILE [ASAM OpenCRG 1.2.0,
// 3.4.6].
//
//   $ROAD_CRG_FILE
//   control.crg                       several files: options, modifiers and data apart
//   ../roads/
//   track.crg                         a path on several lines
//   $roads/track.crg                  an environment variable
//
// The standard allows several files in a section and a path on several lines, and does not say how
// to distinguish these. A path ends here with a line that ends in ".crg" or that completes the name
// of an existing file. Paths are relative to the folder of the file that names them. If several
// files define the same statement, the last one counts; sections of the referring file itself, even
// empty ones, take precedence over those of the files to which it refers.
#pragma once

#include <filesystem>
#include <functional>
#include <string>
#include <vector>

#include "formats/road/open_crg_header.h"

namespace latsch::formats {

/// The file that has the data, and the options and modifiers that apply to it.
struct ResolvedCrg {
  std::string bytes;                         // the file with the data
  OpenCrgHeader header;                      // head, options and modifiers that apply
  std::vector<std::filesystem::path> files;  // all files that were opened, in this order
  std::vector<Place> named_in;               // file and line that name each of these files
};

/// Throws InputError: a file that does not exist or refers to itself, a variable that is not set,
/// no data, data beside a reference.
ResolvedCrg resolve_open_crg(const std::filesystem::path& file);

/// Throws InputError if the file is larger than 256 MB.
void check_open_crg_size(std::string_view bytes, const std::string& file);

}  // namespace latsch::formats
