// SPDX-License-Identifier: Apache-2.0
// Writes what a command computed as a TYDEX file, and says what a reader of the file has to know.
#pragma once

#include <string>

#include "formats/tables/tydex_writer.h"

namespace latsch::cli {

/// True if the name of a file ends as those of TYDEX do.
bool is_tydex(const std::string& file);

/// Writes the file with program and date of the export, and returns its names and rounding.
formats::WrittenTydex write_tydex(formats::TydexRecord record,
                                  formats::TydexDigits digits,
                                  const std::string& file);

/// Says axes, names that TYDEX does not define, and rounding, also as "tydex" of the answer.
/// `more_digits` says how to write every digit.
void say_remarks(const formats::WrittenTydex& written, const std::string& more_digits);

}  // namespace latsch::cli
