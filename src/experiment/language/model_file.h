// SPDX-License-Identifier: Apache-2.0
// Distinguishes files of models and studies in TOML from files of other programs.
#pragma once

#include <filesystem>

namespace latsch::experiment {

/// False for .tir and .inp, in upper or lower case; every other file is read as TOML.
bool is_document(const std::filesystem::path& file);

}  // namespace latsch::experiment
