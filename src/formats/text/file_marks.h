// SPDX-License-Identifier: Apache-2.0
// Recognizes kinds of files by their first bytes, so that a file with a wrong extension is refused
// with what it is and not with what its reader misses in it.
#pragma once

#include <filesystem>
#include <string>
#include <string_view>
#include <vector>

namespace latsch::formats {

struct FileMark {
  std::string words;                 // "an MDF 4 file"
  std::vector<std::string> endings;  // extensions of such files, ".mf4"; empty: none is read
  std::string advice;                // states what to do with a file that is not read
};

/// Returns the kind of a file by its first bytes; nullptr for any other. 512 bytes are enough.
const FileMark* find_file_mark(std::string_view head);

/// Throws InputError if a text begins with the first bytes of another kind of file than its
/// extension says.
void expect_content_of_ending(const std::filesystem::path& file, std::string_view head);

/// Throws InputError if the first bytes of a regular file are those of another kind than its
/// extension says. Does nothing for a file that does not exist or cannot be read.
void expect_content_of_ending(const std::filesystem::path& file);

}  // namespace latsch::formats
