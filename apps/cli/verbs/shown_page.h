// SPDX-License-Identifier: Apache-2.0
// Writes the content of a file as one HTML page that needs no other file.
#pragma once

#include <filesystem>
#include <string>

#include "cli/verbs/shown_file.h"

namespace latsch::cli {

std::string shown_page(const std::filesystem::path& file, const ShownFile& shown);

}  // namespace latsch::cli
