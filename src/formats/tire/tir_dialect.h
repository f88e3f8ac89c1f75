// SPDX-License-Identifier: Apache-2.0
// Dialects of .tir files: which equations FITTYP and PROPERTY_FILE_FORMAT name, and the names that
// dialects have for common coefficients.
//
// FITTYP [MF-Tyre/MF-Swift]: 5, 51 are MF-Tyre 5.0 and 5.1; 6, 52 are 5.2; 21 is 5.2 with the ring
// of SWIFT; 60, 61, 62 are 6.0, 6.1, 6.2. MF-MCTyre, the formula for motorcycles, also used 51 and
// 52: a file that names this formula is refused. PROPERTY_FILE_FORMAT names the formula if there is
// no FITTYP: PAC2002 is MF 5.2 with inflation pressure [Adams/Tire, PAC2002]. Upper and lower case,
// blanks, - and _ in the name of a format do not matter.
#pragma once

#include <string>
#include <string_view>
#include <vector>

#include "formats/text/teim_orbit.h"
#include "models/magic_formula/parameters.h"

namespace latsch::formats {

struct TirDialect {
  magic_formula::Version version = magic_formula::Version::mf61;
  bool pac2002 = false;  // true: keys that are added to the file have the names of PAC2002
  std::vector<std::string> notes;  // messages on how the file was interpreted, each with its place
};

/// Throws InputError, which quotes the file, for a formula that is not supported, and for a file
/// that names no formula or two.
TirDialect dialect_of(const TeimOrbitSection& model);

/// Returns the name of the parameter for a key (in capitals) of any dialect, such as PPZ1 for QPZ1
/// and INFLPRES for IP. Returns the key itself if it has no other name.
std::string_view parameter_of_key(std::string_view key);
/// Returns PAC2002's spelling of a parameter.
std::string_view pac2002_spelling(std::string_view parameter);
/// Returns all keys that are other names of parameters.
std::vector<std::string> other_spellings();

}  // namespace latsch::formats
