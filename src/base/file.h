// SPDX-License-Identifier: Apache-2.0
// Whole text files: read with a limit, written so that a crash or a full disk leaves either the old
// file or the new one, never half of it.
#pragma once

#include <cstddef>
#include <filesystem>
#include <string>
#include <string_view>

namespace latsch {

/// Throws InputError naming the path and the reason: missing, a folder, no permission, over the
/// limit.
std::string read_text_file(const std::filesystem::path& file, std::size_t limit = 64u << 20);

/// Writes a temporary file beside it, flushes it to the disk and renames it. Throws InputError
/// naming the path and the reason, such as a full disk; the old file is then untouched.
void write_text_file(const std::filesystem::path& file, std::string_view text);

}  // namespace latsch
