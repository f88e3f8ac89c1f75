// SPDX-License-Identifier: Apache-2.0
// Magic Formula tires in .tir files: MF-Tyre/MF-Swift 5.0 to 5.2, 6.0 to 6.2 and PAC2002, which is
// 5.2 with inflation pressure (tir_dialect.h).
//
// Every coefficient is looked for by its name in any section but [UNITS] and [MDI_HEADER] and
// converted to SI. Keys of PAC2002 with another name are read for what they are: QPZ1 is PPZ1,
// QPX1 is PPMX1, IP_NOM is NOMPRES; its factors LIP and LCZ multiply NOMPRES and
// VERTICAL_STIFFNESS. `keys` says of every key of the file what it was taken for, or why it has no
// effect (tir_keys.h); what a user has to know stands in `notes`: what is odd or unknown, what the
// file leaves out and what was assumed for it. Without its UNLOADED_RADIUS, FNOMIN or
// VERTICAL_STIFFNESS a file is no tire; a scaling factor of 0 that the equations divide by, a range
// turned round and a parameter among the units are refused.
#pragma once

#include <filesystem>
#include <functional>
#include <map>
#include <string>
#include <string_view>
#include <vector>

#include "formats/text/teim_orbit.h"
#include "models/magic_formula/parameters.h"

namespace latsch::formats {

/// What a key of a file was taken for.
struct TirKey {
  std::string section, key;
  int line = 0;
  std::string parameter;  // or FITTYP, TYRESIDE, USE_MODE; "" where it is not used
  std::string remark;     // why it is not used, or in what alone it acts
};

/// The remark of a key that no dialect here has.
inline constexpr const char* kUnknownKey = "is not known here";

struct TirFile {
  magic_formula::Parameters parameters;
  std::vector<TirKey> keys;  // of all sections, in the order of the file
  bool pac2002 = false;      // PROPERTY_FILE_FORMAT is PAC2002
  /// Factors of the file that are in a parameter already: {"NOMPRES", LIP}.
  std::map<std::string, double, std::less<>> scales;
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
