// SPDX-License-Identifier: Apache-2.0
// Writes the section [UNITS] of a TeimOrbit file in SI, so that a reader which knows only SI reads
// the same numbers: LENGTH = 'mm' becomes LENGTH = '0.001 m'.
#pragma once

#include <string>

namespace latsch::formats {

/// Returns the text of the file with other words in [UNITS]; every other byte stays. Throws
/// InputError for an unknown unit.
std::string with_si_units(const std::string& text, const std::string& file_name);

}  // namespace latsch::formats
