// SPDX-License-Identifier: Apache-2.0
// The keys of a model's file, as reading it declares them.
#pragma once

#include <filesystem>
#include <map>
#include <string>

#include "base/document_record.h"

namespace latsch::experiment {

/// Reads a TOML file of a finite-element tire, a flexible ring, a suspension or a car and returns
/// every key that its readers request, by its path. Keys of a car's suspensions and tires are left
/// out: they are those of their own files. Throws InputError for a wrong file or one of another
/// kind.
std::map<std::string, DeclaredKey> keys_of_model(const std::filesystem::path& file);

}  // namespace latsch::experiment
