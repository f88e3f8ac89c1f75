// SPDX-License-Identifier: Apache-2.0
// Reads and writes Magic Formula tires in .tir files: MF-Tyre/MF-Swift 5.0 to 5.2, 6.0 to 6.2 and
// PAC2002, which is 5.2 with inflation pressure (tir_dialect.h).
//
// Every coefficient is searched for by its name in any section except [UNITS] and [MDI_HEADER] and
// converted to SI. Keys for which PAC2002 has another name are recognized: QPZ1 is PPZ1, QPX1 is
// PPMX1, IP_NOM is NOMPRES; its factors LIP and LCZ multiply NOMPRES and VERTICAL_STIFFNESS. `keys`
// says for every key of the file which parameter it sets, or why it has no effect (tir_keys.h);
// `notes` are messages for the user: odd and unknown keys, missing ones and the assumed values.
//
// A file without UNLOADED_RADIUS, FNOMIN or VERTICAL_STIFFNESS is no tire and is refused, and so
// are a scaling factor of 0 by which the equations divide, a range with exchanged ends, and a
// parameter among the units.
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

/// Interpretation of a key of the file.
struct TirKey {
  std::string section, key;
  int line = 0;
  std::string parameter;  // parameter, FITTYP, TYRESIDE or USE_MODE; "" if the key is not used
  /// reason why the key is not used, or the modes in which alone it has an effect
  std::string remark;
};

/// Remark of a key that no supported dialect has.
inline constexpr const char* kUnknownKey = "is not known here";

struct TirFile {
  magic_formula::Parameters parameters;
  std::vector<TirKey> keys;  // keys of all sections, in the order of the file
  bool pac2002 = false;      // true if PROPERTY_FILE_FORMAT is PAC2002
  /// For each parameter, the scaling factor by which it has already been multiplied: {"NOMPRES",
  /// LIP}.
  std::map<std::string, double, std::less<>> scales;
  /// Messages on odd, unknown or missing keys: one sentence each, with its place.
  std::vector<std::string> notes;
  /// Doubts about statements that contradict the numbers or request something that is not computed:
  /// a missing unit, sizes that no tire has, a range in degrees although the unit is radians,
  /// USE_MODE. They belong to the ledger and not to the notes.
  std::vector<LedgerDoubt> doubts;
  /// Keys of [UNITS] that the file does not state and for which SI, the default of MF-Tyre, is
  /// assumed.
  std::vector<std::string> assumed_units;
  TeimOrbit source;
};

/// Throws InputError naming file and line.
TirFile read_tir(const std::filesystem::path& file);
TirFile parse_tir(std::string text, std::string file_name);

/// Returns the text of the file with other parameters: only values that differ from
/// `tir.parameters` are replaced, missing keys are added at the end, every other byte stays.
std::string tir_text(const TirFile& tir, const magic_formula::Parameters& parameters);

/// Comments for a new file. A remark must not contain a line break.
struct TirRemarks {
  /// Lines below [MDI_HEADER], each with its comment mark and line end.
  std::string header;
  /// Remarks after the values of parameters, FITTYP, TYRESIDE or USE_MODE, without comment marks. A
  /// parameter with a remark is written even if it has its default value.
  std::map<std::string, std::string, std::less<>> of_keys;
  /// Remarks below the heads of sections, without comment marks. A section with a remark is written
  /// even if it has no key.
  std::map<std::string, std::string, std::less<>> of_sections;
};

/// True for a parameter that is written whatever its value, because other programs may take 0 for
/// one that is missing: scaling factors, PKY4, Q_RE0, VXLOW, speed and pressures.
bool is_always_written(const magic_formula::ParameterField& field, magic_formula::Version version);

/// Returns a new file in SI; reading it gives the same parameters.
std::string tir_text(const magic_formula::Parameters& parameters, const TirRemarks& remarks = {});

/// Returns the remarks after the values in a file, without their marks, by parameter, FITTYP,
/// TYRESIDE or USE_MODE; every parameter of the file has an entry, which may be empty.
std::map<std::string, std::string, std::less<>> remarks_of(const TirFile& tir);

}  // namespace latsch::formats
