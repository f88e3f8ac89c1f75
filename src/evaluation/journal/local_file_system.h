// SPDX-License-Identifier: Apache-2.0
// Whether the files of a folder are seen by this machine alone.
//
// SQLite's write-ahead log needs memory shared by all who read and write: safe where one kernel
// keeps the files, lost trials where two do. So it is allowed on the file systems known to be local
// and on no other: a cluster's may be any, and one in user space (FUSE) does not say what is behind
// it, sshfs or a local disk.
// [Numbers: statfs(2), linux/magic.h and the file systems' own sources]
#pragma once

#include <filesystem>
#include <optional>
#include <string>
#include <string_view>

namespace latsch {

/// Its name, "ext4", by the number statfs(2) gives; nullopt for one that is not known to be local.
std::optional<std::string_view> local_file_system(unsigned long kind);

/// What the folder of the file, links followed, lies on where that is not known to be local: "NFS",
/// "a file system that is not known to be local (0x1234)"; nullopt where it is.
std::optional<std::string> shared_file_system(const std::filesystem::path& file);

/// The same of a number.
std::optional<std::string> shared_file_system(unsigned long kind);

}  // namespace latsch
