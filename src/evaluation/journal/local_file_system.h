// SPDX-License-Identifier: Apache-2.0
// Determines if the files of a folder are used by this machine alone.
//
// SQLite's write-ahead log needs memory shared by all who read and write. This is safe if only one
// machine accesses the files; if two machines do, trials are lost. The log is therefore allowed
// only on file systems known to be local. The file system of a cluster can be of any type, and one
// in user space (FUSE) does not report if its files come from sshfs or from a local disk. [Numbers:
// statfs(2), linux/magic.h and the file systems' own sources]
#pragma once

#include <filesystem>
#include <optional>
#include <string>
#include <string_view>

namespace latsch {

/// Returns the name, such as "ext4", for the number from statfs(2); nullopt if it is not known to
/// be local.
std::optional<std::string_view> local_file_system(unsigned long kind);

/// Returns a description of the file system that holds the file, after following links: "NFS", or
/// "a file system that is not known to be local (0x1234)". Returns nullopt if the file system is
/// local.
std::optional<std::string> shared_file_system(const std::filesystem::path& file);

/// Returns the same description for a number from statfs(2).
std::optional<std::string> shared_file_system(unsigned long kind);

}  // namespace latsch
