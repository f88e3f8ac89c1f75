// SPDX-License-Identifier: Apache-2.0
// Reads whole files up to a size limit and writes them according to what exists at their path. All
// output for the user is written by write_file(), so that it behaves alike.
//
//   nothing, a regular file   a temporary file beside the path is written, flushed to the disk and
//                             renamed: a crash or a full disk leaves either the old file or the new
//                             one, never half of it. Owner and permissions stay.
//   links                     stay; the file they lead to is written
//   a device, a pipe          stays and is written to
//   standard output           (/dev/stdout, or -o FILE > FILE) is written to, after the earlier
//                             output
//   a folder, a disk          is refused
//   a file that was read      is refused, once protect_read_files() is called
//   a database, as a journal  is refused: no output replaces it
//
// A regular file is written in place if it cannot be replaced: its folder may be write-protected,
// or the file may be a mount point. Other names (hard links) of a replaced file keep the old text.
#pragma once

#include <cstddef>
#include <filesystem>
#include <functional>
#include <iosfwd>
#include <string>
#include <string_view>

namespace latsch {

/// Throws InputError if the path leads to a pipe or a socket. Its contents can be read only once,
/// but the files of a study are read several times, also by workers, and a pipe that nobody writes
/// would never end. Every function that reads a file of the user calls this.
void expect_no_pipe(const std::filesystem::path& file);

/// Throws InputError naming the path and the reason: nothing is there, or a folder, a pipe or a
/// socket. For commands that ask more of a file, such as its ending, before they read it.
void expect_file(const std::filesystem::path& file);

/// Throws InputError naming the path and the reason: the file is missing, is a folder or a pipe,
/// may not be read, or is larger than the limit.
std::string read_text_file(const std::filesystem::path& file, std::size_t limit = 64u << 20);

/// Writes what `write` puts into the stream. Throws InputError naming the path and the reason, such
/// as a full disk, and whatever `write` throws; a regular file then stays as it was.
void write_file(const std::filesystem::path& file, const std::function<void(std::ostream&)>& write);

/// Writes a text as write_file() does.
void write_text_file(const std::filesystem::path& file, std::string_view text);

/// Makes write_file() refuse to replace a file that this process has read and not written itself.
/// Such a file is an input of the same command, named as its output by mistake.
void protect_read_files();
/// Records that an open file is read; read_text_file() calls this itself.
void note_read(int descriptor);
/// Lets write_file() replace this file although it was read.
void allow_to_replace(const std::filesystem::path& file);

/// Renames a file. Throws InputError.
void move_file(const std::filesystem::path& file, const std::filesystem::path& to);

}  // namespace latsch
