// SPDX-License-Identifier: Apache-2.0
// Whole files: read with a limit; written through what stands at their path. Everything the program
// writes for its user goes through write_file(), so that it is the same everywhere.
//
//   nothing, a regular file   a temporary file beside it, flushed to the disk and renamed: a crash
//                             or a full disk leaves either the old file or the new one, never
//                             half of it. Owner and permissions stay.
//   links                     stay; the file they lead to is the one that is written
//   a device, a pipe          stays and is written to
//   what we print to          (/dev/stdout, or -o FILE > FILE) is written to, after what was
//                             printed
//   a folder, a disk          is refused
//
// A regular file is written in place where it cannot be replaced: its folder may not be written, or
// it was mounted by itself. Other names (hard links) of a replaced file keep the old text.
#pragma once

#include <cstddef>
#include <filesystem>
#include <functional>
#include <iosfwd>
#include <string>
#include <string_view>

namespace latsch {

/// Throws InputError naming the path and the reason: missing, a folder, no permission, over the
/// limit.
std::string read_text_file(const std::filesystem::path& file, std::size_t limit = 64u << 20);

/// Writes what `write` puts into the stream. Throws InputError naming the path and the reason, such
/// as a full disk, and what `write` throws; a regular file is then as it was.
void write_file(const std::filesystem::path& file, const std::function<void(std::ostream&)>& write);

/// The same of a text.
void write_text_file(const std::filesystem::path& file, std::string_view text);

/// Gives a file another name in its folder. Throws InputError.
void move_file(const std::filesystem::path& file, const std::filesystem::path& to);

}  // namespace latsch
