// SPDX-License-Identifier: Apache-2.0
#include "evaluation/network_file_system.h"

#include <sys/vfs.h>

#include <array>

namespace latsch {

std::optional<std::string_view> network_file_system(unsigned long kind) {
  struct Kind {
    unsigned long magic;
    std::string_view name;
  };
  static constexpr std::array kNetwork{Kind{0x6969, "NFS"},
                                       Kind{0x517B, "SMB"},
                                       Kind{0xFF534D42, "CIFS"},
                                       Kind{0xFE534D42, "SMB2"},
                                       Kind{0x5346414F, "AFS"},
                                       Kind{0x01021997, "9P"},
                                       Kind{0x00C36400, "Ceph"},
                                       Kind{0x0BD00BD0, "Lustre"},
                                       Kind{0x47504653, "GPFS"},
                                       Kind{0x65735546, "FUSE"}};
  for (const Kind& network : kNetwork) {
    if ((kind & 0xFFFFFFFFu) == network.magic) return network.name;
  }
  return std::nullopt;
}

std::optional<std::string_view> network_file_system(const std::filesystem::path& file) {
  struct statfs info {};
  const std::filesystem::path folder = file.has_parent_path() ? file.parent_path() : ".";
  if (::statfs(folder.c_str(), &info) != 0) return std::nullopt;
  return network_file_system(static_cast<unsigned long>(info.f_type));
}

}  // namespace latsch
