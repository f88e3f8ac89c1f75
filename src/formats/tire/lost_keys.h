// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <filesystem>
#include <string>
#include <vector>

namespace latsch::formats {

/// Returns the keys and tables of a .tir that have no effect here and that the text of an exported
/// .tir does not contain, or contains as comments (kept_parts.h). Returns nothing for a file of
/// another kind.
std::vector<std::string> lost_keys(const std::filesystem::path& file, const std::string& exported);

}  // namespace latsch::formats
