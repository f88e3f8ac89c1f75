// SPDX-License-Identifier: Apache-2.0
// Magic Formula tires in .tir files: MF-Tyre/MF-Swift 5.0 to 5.2, 6.0 to 6.2 and PAC2002, which is
// 5.2 with inflation pressure (tir_dialect.h).
//
// Every coefficient is searched for by its name in any section except [UNITS] and [MDI_HEADER] and
// converted to SI. Keys of PAC2002 with another name are recognized: QPZ1 is PPZ1, QPX1 is PPMX1,
// IP_NOM is NOMPRES; its factors LIP and LCZ multiply NOMPRES and VERTICAL_STIFFNESS. `keys` says
// for every key of the file which parameter it is, or why it has no effect (tir_keys.h); `notes`
// says what the user has to know: odd and unknown keys, missing ones and the assumed values. A file
// without UNLOADED_RADIUS, FNOMIN or VERTICAL_STIFFNESS is no tire and is refused, and so are a
// scaling factor of 0 that the equations divide by, a range with exchanged ends and a parameter
// among the units.
#pragma once

#include <filesystem>
#include <functional>
#include <map>
#include <string>
#include <string_view>
#include <vector>

#include "formats/text/teim_orbit.h"
#include "measurement/ledger.h"
#include "models/magic_formula/parameters.h"

namespace latsch::formats {

/// Interpretation of a key of a file.
struct TirKey {
  std::string section, key;
  int line = 0;
  std::string parameter;  // parameter, or FITTYP, TYRESIDE, USE_MODE; "" if the key is not used
  std::string remark;     // reason why it is not used, or the only modes in which it acts
};

/// The remark of a key that no dialect here has.
inline constexpr const char* kUnknownKey = "is not known here";

struct TirFile {
  magic_formula::Parameters parameters;
  std::vector<TirKey> keys;  // keys of all sections, in the order of the file
  bool pac2002 = false;      // true if PROPERTY_FILE_FORMAT is PAC2002
  /// Factors of the file that are already applied to a parameter: {"NOMPRES", LIP}.
  std::map<std::string, double, std::less<>> scales;
  /// Odd, unknown or missing keys: one sentence each, with its place.
  std::vector<std::string> notes;
  /// Statements that contradict the numbers or ask for something that is not computed: a missing
  /// unit, sizes that no tire has, a range in degrees beside radians, USE_MODE. They are part of
  /// the ledger and not of the notes.
  std::vector<LedgerDoubt> doubts;
  /// Keys of [UNITS] that the file does not state and that are taken as SI, the default of MF-Tyre.
  std::vector<std::string> assumed_units;
  TeimOrbit source;
};

/// Throws InputError naming file and line.
TirFile read_tir(const std::filesystem::path& file);
TirFile parse_tir(std::string text, std::string file_name);

/// Returns the file with other values: only those that differ from `tir.parameters` are replaced,
/// missing keys are added at the end, every other byte stays.
std::string tir_text(const TirFile& tir, const magic_formula::Parameters& parameters);

/// Comments of a new file. No remark may contain a line break.
struct TirRemarks {
  /// Lines below [MDI_HEADER], each with its mark and its end.
  std::string header;
  /// Remarks behind the value of a parameter, FITTYP, TYRESIDE or USE_MODE, without a mark. A
  /// parameter that has a remark is written even at its default.
  std::map<std::string, std::string, std::less<>> of_keys;
  /// Remarks below the head of a section, without a mark. A section that has one is written even if
  /// it has no key.
  std::map<std::string, std::string, std::less<>> of_sections;
};

/// Returns a new file in SI; reading it gives the same parameters.
std::string tir_text(const magic_formula::Parameters& parameters, const TirRemarks& remarks = {});

/// Returns the remarks behind the values of a file, without their marks, by parameter, FITTYP,
/// TYRESIDE or USE_MODE; every parameter of the file has an entry, which may be empty.
std::map<std::string, std::string, std::less<>> remarks_of(const TirFile& tir);

}  // namespace latsch::formats
