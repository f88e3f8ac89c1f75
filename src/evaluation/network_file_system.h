// SPDX-License-Identifier: Apache-2.0
// Whether files in a folder may be seen by several machines at once.
//
// A file system in user space (FUSE) does not say what is behind it, sshfs or a local disk: it
// counts as one.
#pragma once

#include <filesystem>
#include <optional>
#include <string_view>

namespace latsch {

/// Its name, "NFS", by the number statfs(2) gives; nullopt for a local one.
std::optional<std::string_view> network_file_system(unsigned long kind);

/// That of the folder the file is in, or will be.
std::optional<std::string_view> network_file_system(const std::filesystem::path& file);

}  // namespace latsch
