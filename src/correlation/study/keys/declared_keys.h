// SPDX-License-Identifier: Apache-2.0
// Determines the keys of a study by reading samples and recording the keys that are read.
#pragma once

#include <filesystem>
#include <map>
#include <string>

#include "base/document_record.h"
#include "experiment/language.h"

namespace latsch::correlation {

/// Reads a study and returns every key that its readers request, by its path. Throws InputError.
std::map<std::string, DeclaredKey> keys_of_study(const std::filesystem::path& file,
                                                 const experiment::Language& language);

}  // namespace latsch::correlation
