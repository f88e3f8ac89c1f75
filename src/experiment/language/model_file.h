// SPDX-License-Identifier: Apache-2.0
// Which files of models and studies are tables and keys (TOML), and which another program's.
#pragma once

#include <filesystem>

namespace latsch::experiment {

/// False for a .tir and an .inp, in any case of letters; every other file is read as TOML.
bool is_document(const std::filesystem::path& file);

}  // namespace latsch::experiment
