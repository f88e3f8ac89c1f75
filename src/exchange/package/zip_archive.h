// SPDX-License-Identifier: Apache-2.0
// Writes a ZIP file in memory [PKWARE, APPNOTE.TXT 6.3.10, 4.3]: deflated files with names in UTF-8
// and without extensions of the format, so that every reader takes it. Holds less than 4 GiB and
// 65,535 files.
//
// Equal content gives equal bytes, because all files have the first date that a ZIP file can state.
#pragma once

#include <cstdint>
#include <string>
#include <string_view>

namespace latsch::exchange {

class ZipArchive {
 public:
  /// Adds a file; folders in its name are separated by "/". Throws std::runtime_error if the
  /// archive would be too large for the format.
  void add(std::string_view name, std::string_view bytes);
  /// Returns the bytes of the ZIP file with all files that were added.
  std::string bytes() const;

 private:
  std::string files_;      // each with its local header [4.3.7]
  std::string directory_;  // central directory headers [4.3.12]
  std::uint32_t count_ = 0;
};

}  // namespace latsch::exchange
