// SPDX-License-Identifier: Apache-2.0
// The bytes of the records of an MDF 4 data group: one block or a list of blocks, deflated or not.
#pragma once

#include <cstddef>
#include <string>
#include <string_view>

#include "formats/recorders/mdf_blocks.h"

namespace latsch::formats {

/// Bytes of records: a part of the file, or a copy if they had to be joined or unpacked.
struct MdfBytes {
  std::string copy;
  std::string_view in_file;
  std::string_view view() const { return copy.empty() ? in_file : std::string_view(copy); }
};

/// Reads the bytes of all data groups of a file. Together they unpack at most 1 GiB, and no byte of
/// the file is used twice.
class MdfData {
 public:
  MdfData(const MdfBlocks& blocks, bool is_unfinished)
      : blocks_(blocks), is_unfinished_(is_unfinished) {}

  /// Throws InputError for a broken list, a compression other than deflate, and bytes that several
  /// blocks claim.
  MdfBytes read(std::uint64_t position);

 private:
  void take(std::uint64_t position, MdfChain& chain, MdfBytes& bytes);
  void take_list(MdfBlock list, MdfChain& chain, MdfBytes& bytes);
  void append(std::string_view part, MdfBytes& bytes);
  void unpack(const MdfBlock& block, MdfBytes& bytes);

  const MdfBlocks& blocks_;
  bool is_unfinished_;
  std::size_t used_ = 0;      // bytes of the file
  std::size_t unpacked_ = 0;  // bytes
};

}  // namespace latsch::formats
