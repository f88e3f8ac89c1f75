// SPDX-License-Identifier: Apache-2.0
// Holds a binary or universal file of a recorder as its readers return it: groups of channels that
// share one time or frequency, with the units as the file states them.
//
// The readers believe no length before it is compared with the file. Together they allocate at most
// eight bytes for each byte of the file, or 1 GiB if that is more, and unpack at most 1 GiB.
#pragma once

#include <cstddef>
#include <filesystem>
#include <map>
#include <string>
#include <string_view>
#include <vector>

namespace latsch::formats {

struct RecordedChannel {
  std::string name;
  std::string unit = {};            // text of the file; empty: none
  std::vector<double> values = {};  // in that unit; NaN: a gap
  std::string remark = {};          // a note about the numbers, for the ledger
};

/// Channels with equally many samples, taken at the same times.
struct RecordedGroup {
  std::string name;
  std::vector<RecordedChannel> channels;  // the abscissa first, if there is one
  bool has_abscissa = false;
  std::size_t samples() const { return channels.empty() ? 0 : channels.front().values.size(); }
};

struct RecordedFile {
  std::string file;
  std::string kind;  // "Universal file 58", "MDF 4.10", "TDMS"
  std::vector<RecordedGroup> groups;
  std::map<std::string, std::string> left_out;  // name -> why, to follow the name
  std::vector<std::string> facts;               // header texts
  std::vector<std::string> doubts;              // full sentences on what was not read, or assumed
};

/// Returns the extensions of these files, in lower case.
std::vector<std::string> recorder_endings();
/// Reads a file by its extension. Throws InputError if it is broken, larger than 2 GB, or has no
/// channel that can be read.
RecordedFile read_recorded_file(const std::filesystem::path& file);

/// Counts the memory of numbers. take() throws InputError if more is wanted than the header of this
/// file allows.
class NumberBudget {
 public:
  NumberBudget(std::string file, std::size_t bytes_of_file);
  void take(std::size_t numbers);

 private:
  std::string file_;
  std::size_t left_;  // bytes
};

/// Returns a name or unit of a file as UTF-8, up to the first zero byte, without control characters
/// and blanks around it. Bytes that are no UTF-8 are taken as Windows-1252.
std::string recorded_text(std::string_view bytes, const std::string& file);
/// Returns bytes of a file in quotes for a message: at most 20, the unprintable ones as dots.
std::string shown_bytes(std::string_view bytes);
/// Adds " #2", " #3" and so on to names that occur again in a group and leaves a remark.
void tell_equal_names_apart(RecordedGroup& group);
/// Throws if no group has a channel, and adds a doubt if the abscissa of a group falls back or has
/// gaps.
void check_recorded(RecordedFile& file);

}  // namespace latsch::formats
