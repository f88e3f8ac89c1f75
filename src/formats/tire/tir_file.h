// SPDX-License-Identifier: Apache-2.0
// Magic Formula tires in .tir files: MF-Tyre/MF-Swift 5.2, 6.1, 6.2 and PAC2002 (read as 5.2).
//
// Every coefficient is looked for by its name in any section but [UNITS] (there MASS is a unit, in
// [INERTIA] the tire's) and converted to SI. FITTYP says the version: 6, 21 or 5 are MF 5.2, 61 and
// 62 themselves; PAC2002 files have none. Keys that no equation here knows stay in the file and are
// named in `notes`, as is what the file leaves out and what was assumed for it. Without its
// UNLOADED_RADIUS, FNOMIN or VERTICAL_STIFFNESS a file is no tire.
#pragma once

#include <filesystem>
#include <string>
#include <string_view>
#include <vector>

#include "formats/text/teim_orbit.h"
#include "models/magic_formula/parameters.h"

namespace latsch::formats {

struct TirFile {
  magic_formula::Parameters parameters;
  /// Odd, unknown or missing: one sentence each, with its place.
  std::vector<std::string> notes;
  TeimOrbit source;
};

/// InputError naming file and line.
TirFile read_tir(const std::filesystem::path& file);
TirFile parse_tir(std::string text, std::string file_name);

/// The file with other values: only those that differ from `tir.parameters` are replaced, what the
/// file does not have is put at its end, every other byte stays.
std::string tir_text(const TirFile& tir, const magic_formula::Parameters& parameters);

/// A new file, in SI; reading it gives the same parameters.
std::string tir_text(const magic_formula::Parameters& parameters);

}  // namespace latsch::formats
