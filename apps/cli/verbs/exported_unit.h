// SPDX-License-Identifier: Apache-2.0
// latsch export --fmu, --sti: a model for programs that simulate what it is a part of.
#pragma once

#include <string>

#include "experiment/language.h"

namespace latsch::cli {

/// Writes the package of FMI "2.0" or "3.0" of a tire that rolls or of a car, on the road of a file
/// (empty: flat). InputError.
void write_fmu(const std::string& file,
               const std::string& version,
               const std::string& road,
               const std::string& output,
               const experiment::Language& language);

/// Says which library and which file a program with the Standard Tyre Interface needs. InputError
/// where it would not take the file.
void say_sti(const std::string& file, const experiment::Language& language);

}  // namespace latsch::cli
