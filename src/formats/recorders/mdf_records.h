// SPDX-License-Identifier: Apache-2.0
// Records of the channel groups of an MDF 4 data group: told apart by their ids, and counted.
#pragma once

#include <cstdint>
#include <string>
#include <string_view>
#include <vector>

#include "formats/recorders/mdf_blocks.h"
#include "formats/recorders/recorded_file.h"

namespace latsch::formats {

/// A channel group, before its records are read.
struct MdfGroup {
  std::string name;
  std::uint64_t at = 0, master_at = 0;  // positions; master_at: the group with the master, or 0
  std::uint64_t id = 0, cycles = 0;
  std::size_t data_bytes = 0, invalid_bytes = 0;
  bool is_vlsd = false, is_bus = false;
  std::uint64_t first_channel = 0;
  std::size_t record() const { return data_bytes + invalid_bytes; }
};

/// Bytes of the records of one channel group.
struct MdfRecords {
  std::string copy;  // the records of an unsorted data group
  std::string_view in_file;
  std::size_t count = 0;
  bool is_cut = false;  // the last record of the data group is not whole
  std::string_view view() const { return copy.empty() ? in_file : std::string_view(copy); }
};

/// Sorts and counts records; what is cut off becomes a doubt of the file.
class MdfRecordSorting {
 public:
  MdfRecordSorting(RecordedFile& file, std::size_t bytes_of_file)
      : file_(file), bytes_of_file_(bytes_of_file) {}

  /// Says that the file was still being written: its last record may be cut off.
  void set_unfinished() { is_unfinished_ = true; }
  /// Copies the records of each channel group behind one another. A last record that is cut off is
  /// left out. Throws InputError, with the data group `block`, for an id of no channel group.
  void sort(std::string_view bytes,
            std::size_t id_bytes,
            const std::vector<MdfGroup>& groups,
            const MdfBlock& block,
            std::vector<MdfRecords>& records);
  /// Sets the number of records. Throws InputError if a finished file has fewer than it states.
  void count(const MdfGroup& group, MdfRecords& records);

 private:
  [[noreturn]] void fail(const std::string& message) const;
  void cut_off(const MdfGroup& group);

  RecordedFile& file_;
  std::size_t bytes_of_file_;
  bool is_unfinished_ = false;
};

}  // namespace latsch::formats
