// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <filesystem>
#include <string>
#include <vector>

namespace latsch::formats {

/// Returns the keys and tables of a .tir file that the text of an exported .tir does not contain;
/// another program may use them. Returns nothing for a file of another kind.
std::vector<std::string> lost_keys(const std::filesystem::path& file, const std::string& exported);

}  // namespace latsch::formats
