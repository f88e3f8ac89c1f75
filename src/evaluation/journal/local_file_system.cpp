// SPDX-License-Identifier: Apache-2.0
#include "evaluation/journal/local_file_system.h"

#include <fmt/format.h>
#include <sys/vfs.h>

#include <array>
#include <span>

namespace latsch {
namespace {

struct FileSystem {
  unsigned long number;
  std::string_view name;
};

constexpr std::array kLocal{FileSystem{0xEF53, "ext4"},  // the number of ext2 and ext3, too
                            FileSystem{0x58465342, "XFS"},
                            FileSystem{0x9123683E, "Btrfs"},
                            FileSystem{0x2FC12FC1, "ZFS"},
                            FileSystem{0xF2F52010, "F2FS"},
                            FileSystem{0xCA451A4E, "bcachefs"},
                            FileSystem{0x3153464A, "JFS"},
                            FileSystem{0x52654973, "ReiserFS"},
                            FileSystem{0x01021994, "tmpfs"},
                            FileSystem{0x858458F6, "ramfs"},
                            // The file system "overlay" is used by containers; its upper layer is
                            // local.
                            FileSystem{0x794C7630, "overlay"},
                            FileSystem{0x4D44, "FAT"},
                            FileSystem{0x2011BAB0, "exFAT"},
                            FileSystem{0x7366746E, "NTFS"}};

// File systems that several machines may share, with their names for messages.
constexpr std::array kShared{FileSystem{0x6969, "NFS"},
                             FileSystem{0x517B, "SMB"},
                             FileSystem{0xFF534D42, "CIFS"},
                             FileSystem{0xFE534D42, "SMB2"},
                             FileSystem{0x5346414F, "AFS"},
                             FileSystem{0x01021997, "9P"},
                             FileSystem{0x00C36400, "Ceph"},
                             FileSystem{0x0BD00BD0, "Lustre"},
                             FileSystem{0x47504653, "GPFS"},
                             FileSystem{0x19830326, "BeeGFS"},
                             FileSystem{0x01161970, "GFS2"},
                             FileSystem{0x7461636F, "OCFS2"},
                             FileSystem{0x65735546, "FUSE"}};

std::optional<std::string_view> name_in(std::span<const FileSystem> list, unsigned long kind) {
  for (const FileSystem& known : list) {
    // Statfs(2) may have extended the sign of a 32-bit number.
    if ((kind & 0xFFFFFFFFu) == known.number) return known.name;
  }
  return std::nullopt;
}

}  // namespace

std::optional<std::string_view> local_file_system(unsigned long kind) {
  return name_in(kLocal, kind);
}

std::optional<std::string> shared_file_system(unsigned long kind) {
  if (local_file_system(kind)) return std::nullopt;
  if (const auto name = name_in(kShared, kind)) return std::string(*name);
  return fmt::format("a file system that is not known to be local (0x{:X})", kind & 0xFFFFFFFFu);
}

std::optional<std::string> shared_file_system(const std::filesystem::path& file) {
  std::error_code none;
  const auto target = std::filesystem::weakly_canonical(file, none);
  const auto folder = (none ? std::filesystem::absolute(file) : target).parent_path();
  struct statfs info {};
  // If the folder cannot be examined, opening the journal will report the reason.
  if (::statfs(folder.c_str(), &info) != 0) return std::nullopt;
  return shared_file_system(static_cast<unsigned long>(info.f_type));
}

}  // namespace latsch
