// SPDX-License-Identifier: Apache-2.0
// Implements `latsch export --fmu` and `--sti`: exports a model to programs that simulate the
// system around it.
#pragma once

#include <string>

#include "experiment/language.h"

namespace latsch::cli {

/// Writes the FMI package, version "2.0" or "3.0", of a rolling tire or of a car, on the road of
/// the file `road` (empty: a flat road). Throws InputError.
void write_fmu(const std::string& file,
               const std::string& version,
               const std::string& road,
               const std::string& output,
               const experiment::Language& language);

/// Prints which library and which file a program that uses the Standard Tyre Interface needs.
/// Throws InputError if the library would not accept the file.
void say_sti(const std::string& file, const experiment::Language& language);

}  // namespace latsch::cli
