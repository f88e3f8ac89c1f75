// SPDX-License-Identifier: Apache-2.0
// Walks the segments of a TDMS file: lead-in, description of objects, raw data [National
// Instruments, "TDMS File Format Internal Structure"].
//
// A segment without a description has the objects of the one before; one without a new list of
// objects changes or adds to that list; an object without an index of its own keeps the last one. A
// segment holds as many chunks as its length has room for. Every position and length is compared
// with the file before it is used.
#pragma once

#include <cstdint>
#include <map>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "formats/recorders/recorded_file.h"
#include "formats/recorders/recorded_numbers.h"

namespace latsch::formats {

/// Time stamp of TDMS: seconds since 1904 and the fraction of a second in units of 2^-64.
struct TdmsStamp {
  std::int64_t seconds = 0;
  std::uint64_t fraction = 0;
  auto operator<=>(const TdmsStamp&) const = default;
};

/// Value of a property; the member for its type is set.
struct TdmsProperty {
  std::string text;
  std::optional<double> number;
  std::optional<TdmsStamp> stamp;
};

/// Raw data of an object in each chunk.
struct TdmsIndex {
  std::uint32_t type = 0;
  std::uint64_t count = 0, bytes = 0;  // values; bytes of a whole chunk
};

/// The file, a group or a channel.
struct TdmsObject {
  std::vector<std::string> names;  // group and channel; none: the file
  std::map<std::string, TdmsProperty> properties;
  std::optional<TdmsIndex> index;  // the last one
  bool is_listed = false, has_data = false;
  std::uint64_t count = 0;     // values in all segments
  std::vector<double> values;  // empty if the channel cannot be read
  std::string fault;           // why not, to follow the name
};

/// Returns names of a path, "/'group'/'channel'", in which a quote is written twice; nothing if it
/// is no path.
std::optional<std::vector<std::string>> tdms_names(std::string_view path);

class TdmsSegments {
 public:
  /// Reads descriptions and numbers of all segments. Throws InputError that names the segment by
  /// its position in bytes. What is cut off becomes a doubt of the file.
  TdmsSegments(std::string_view bytes, RecordedFile& file);
  std::vector<TdmsObject>& objects() { return objects_; }
  NumberBudget& budget() { return budget_; }

 private:
  struct Segment {
    std::size_t at = 0, data_at = 0, end = 0;
    std::uint32_t contents = 0;
    bool is_big_endian = false, is_open = false;  // open: it ends with the file, or behind it
  };
  class Description;

  [[noreturn]] void fail(const Segment& segment, const std::string& message) const;
  void doubt(const std::string& sentence);
  void walk();
  Segment lead_in(std::size_t at);
  bool take_description(const Segment& segment);
  bool take_object(const Segment& segment, Description& description);
  void take_index(const Segment& segment, Description& description, TdmsObject& object);
  void list_data(const Segment& segment);
  void take_data(const Segment& segment);
  std::size_t take_rows(const Segment& segment);
  std::size_t take_chunks(const Segment& segment);
  void take(const Segment& segment,
            std::size_t object,
            std::size_t at,
            std::size_t stride,
            std::uint64_t count);

  std::string_view bytes_;
  RecordedFile& file_;
  NumberBudget budget_;
  bool is_counting_ = true;  // the first walk counts the values, the second one reads them
  std::vector<TdmsObject> objects_;
  std::map<std::string, std::size_t, std::less<>> by_path_;
  std::vector<std::size_t> listed_;  // objects of the segment, in the order of the raw data
  std::vector<std::size_t> data_;    // those of them that have values in it
  std::uint64_t chunk_bytes_ = 0;
};

}  // namespace latsch::formats
