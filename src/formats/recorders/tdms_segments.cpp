// SPDX-License-Identifier: Apache-2.0
#include "formats/recorders/tdms_segments.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>

#include "base/error.h"
#include "base/text.h"

namespace latsch::formats {
namespace {

constexpr std::size_t kLeadIn = 28;                            // bytes
constexpr std::size_t kMostObjects = 100000;                   // in a file
constexpr std::uint64_t kMostValues = std::uint64_t{1} << 48;  // an object has fewer in a chunk
constexpr std::uint32_t kDescribes = 1u << 1, kNewList = 1u << 2, kHasData = 1u << 3;
constexpr std::uint32_t kInterleaved = 1u << 5, kBigEndian = 1u << 6, kDaqmx = 1u << 7;
constexpr std::uint32_t kNoData = 0xffffffffu, kAsBefore = 0;  // in the place of an index
constexpr std::uint64_t kOpenEnd = 0xffffffffffffffffu;        // length of an unclosed segment
constexpr std::uint32_t kText = 0x20, kStamp = 0x44;

/// A type of values: how it is stored, or why its channels are left out.
struct TdmsType {
  std::uint32_t number;
  unsigned bytes;  // a value has so many; 0: not known
  bool is_real, is_signed;
  const char* fault;  // nullptr: it is read
};
constexpr std::array<TdmsType, 21> kTdmsTypes = {{
    {0x01, 1, false, true, nullptr},
    {0x02, 2, false, true, nullptr},
    {0x03, 4, false, true, nullptr},
    {0x04, 8, false, true, nullptr},
    {0x05, 1, false, false, nullptr},
    {0x06, 2, false, false, nullptr},
    {0x07, 4, false, false, nullptr},
    {0x08, 8, false, false, nullptr},
    {0x09, 4, true, true, nullptr},
    {0x0a, 8, true, true, nullptr},
    {0x0b, 0, true, true, "has numbers of extended precision"},
    {0x19, 4, true, true, nullptr},
    {0x1a, 8, true, true, nullptr},
    {0x1b, 0, true, true, "has numbers of extended precision"},
    {kText, 0, false, false, "has texts"},
    {0x21, 1, false, false, nullptr},
    {kStamp, 16, false, false, "has time stamps"},
    {0x4f, 0, false, false, "has fixed-point numbers"},
    {0x08000c, 8, true, true, "has complex numbers"},
    {0x10000d, 16, true, true, "has complex numbers"},
    {0xffffffff, 0, false, false, "has raw data of DAQmx"},
}};

const TdmsType* tdms_type(std::uint32_t number) {
  const auto found = std::find_if(
      kTdmsTypes.begin(), kTdmsTypes.end(), [&](const auto& one) { return one.number == number; });
  return found == kTdmsTypes.end() ? nullptr : &*found;
}

}  // namespace

/// The description of a segment, read from its beginning. Beyond its end everything is 0, and
/// ended() is true.
class TdmsSegments::Description {
 public:
  Description(std::string_view bytes, bool is_big_endian)
      : bytes_(bytes), is_big_endian_(is_big_endian) {}

  bool ended() const { return ended_; }
  std::uint64_t integer(unsigned size) {
    const std::string_view raw = take(size);
    return raw.empty() ? 0 : recorded_integer(raw.data(), size, is_big_endian_);
  }
  std::uint32_t word() { return static_cast<std::uint32_t>(integer(4)); }
  std::string_view text() { return take(word()); }
  std::string_view take(std::size_t size) {
    if (size > bytes_.size()) ended_ = true;
    if (ended_) return {};
    const std::string_view taken = bytes_.substr(0, size);
    bytes_.remove_prefix(size);
    return taken;
  }
  TdmsStamp stamp() {
    TdmsStamp stamp;  // the fraction stands first in a little-endian segment
    if (is_big_endian_) stamp.seconds = static_cast<std::int64_t>(integer(8));
    stamp.fraction = integer(8);
    if (!is_big_endian_) stamp.seconds = static_cast<std::int64_t>(integer(8));
    return stamp;
  }
  bool is_big_endian() const { return is_big_endian_; }

 private:
  std::string_view bytes_;
  bool is_big_endian_, ended_ = false;
};

std::optional<std::vector<std::string>> tdms_names(std::string_view path) {
  std::vector<std::string> names;
  if (path == "/") return names;
  while (!path.empty()) {
    if (!path.starts_with("/'")) return std::nullopt;
    path.remove_prefix(2);
    std::string name;
    while (!path.empty() && (path.front() != '\'' || path.starts_with("''"))) {
      name += path.front();
      path.remove_prefix(path.front() == '\'' ? 2 : 1);
    }
    if (path.empty()) return std::nullopt;
    path.remove_prefix(1);
    names.push_back(std::move(name));
  }
  if (names.empty() || names.size() > 2) return std::nullopt;
  return names;
}

TdmsSegments::TdmsSegments(std::string_view bytes, RecordedFile& file)
    : bytes_(bytes), file_(file), budget_(file.file, bytes.size()) {
  if (bytes.empty()) throw InputError({file.file, 0}, "is empty, expected a TDMS file");
  walk();
  is_counting_ = false;
  for (TdmsObject& object : objects_) {
    if (object.fault.empty()) {
      budget_.take(object.count);
      object.values.reserve(object.count);
    }
    object.index.reset();
    object.is_listed = object.has_data = false;
  }
  listed_.clear();
  data_.clear();
  chunk_bytes_ = 0;
  walk();
}

void TdmsSegments::fail(const Segment& segment, const std::string& message) const {
  throw InputError({file_.file, 0}, fmt::format("segment at byte {} {}", segment.at, message));
}

void TdmsSegments::doubt(const std::string& sentence) {
  if (is_counting_) file_.doubts.push_back(sentence);
}

void TdmsSegments::walk() {
  for (std::size_t at = 0; at < bytes_.size();) {
    if (at > 0 && bytes_.size() - at < kLeadIn) {
      doubt(
          fmt::format("the file is cut off: its last {} bytes are not a whole segment and are not "
                      "read",
                      bytes_.size() - at));
      return;
    }
    const Segment segment = lead_in(at);
    if (!take_description(segment)) {
      doubt(
          fmt::format("the file is cut off within the description of its last segment, at byte "
                      "{}, which is not read",
                      segment.at));
      return;
    }
    take_data(segment);
    at = segment.end;
  }
}

TdmsSegments::Segment TdmsSegments::lead_in(std::size_t at) {
  Segment segment;
  segment.at = at;
  const std::string_view rest = bytes_.substr(at);
  if (rest.starts_with("TDSh"))
    fail(segment, "begins with \"TDSh\": this is an index without numbers, read the .tdms of it");
  if (rest.size() < kLeadIn)
    fail(segment,
         fmt::format("has {} bytes, expected {} or more: the file is cut off",
                     rest.size(),
                     static_cast<std::size_t>(kLeadIn)));
  if (!rest.starts_with("TDSm"))
    fail(segment, fmt::format("begins with {}, expected \"TDSm\"", shown_bytes(rest.substr(0, 4))));
  segment.contents = static_cast<std::uint32_t>(recorded_integer(rest.data() + 4, 4, false));
  segment.is_big_endian = segment.contents & kBigEndian;
  const auto number = [&](std::size_t offset, unsigned size) {
    return recorded_integer(rest.data() + offset, size, segment.is_big_endian);
  };
  if (const std::uint64_t version = number(8, 4); version != 4712 && version != 4713)
    fail(segment, fmt::format("is of version {}, expected 4712 or 4713", version));
  if (segment.contents & kDaqmx)
    fail(segment,
         "has raw data of DAQmx, which are not read: save the channels as numbers, by LabVIEW's "
         "function TDMS Write or the export of the program that recorded them");
  const std::uint64_t length = number(12, 8), description = number(20, 8);
  const std::size_t left = rest.size() - kLeadIn;
  segment.is_open = length > left;
  segment.end = segment.is_open ? bytes_.size() : at + kLeadIn + static_cast<std::size_t>(length);
  if (description > left) {
    if (!segment.is_open) fail(segment, "has raw data behind its end");
    segment.data_at = segment.end;
  } else {
    segment.data_at = at + kLeadIn + static_cast<std::size_t>(description);
  }
  if (segment.data_at > segment.end) fail(segment, "has raw data behind its end");
  if (!segment.is_open) return segment;
  if (const std::size_t next = bytes_.find("TDSm", segment.data_at); next != bytes_.npos)
    fail(segment,
         fmt::format("states a length of {} bytes where {} are left, but another segment begins at "
                     "byte {}",
                     length,
                     left,
                     next));
  if (length == kOpenEnd) {
    doubt(
        "the file was not closed: its last segment states no length and is read up to its last "
        "whole record");
  } else {
    doubt(
        fmt::format("the file is cut off: its last segment states {} bytes and has {}, and is "
                    "read up to its last whole record",
                    length,
                    left));
  }
  return segment;
}

/// Returns false if the file ends within the description of its last segment.
bool TdmsSegments::take_description(const Segment& segment) {
  if (!(segment.contents & kDescribes)) return true;
  if (segment.contents & kNewList) {
    for (const std::size_t one : listed_) objects_[one].is_listed = objects_[one].has_data = false;
    listed_.clear();
  }
  const std::size_t begin = segment.at + kLeadIn;
  Description description(bytes_.substr(begin, segment.data_at - begin), segment.is_big_endian);
  const std::uint32_t count = description.word();
  bool is_whole = !description.ended();
  for (std::uint32_t i = 0; is_whole && i < count; ++i)
    is_whole = take_object(segment, description);
  if (!is_whole && !segment.is_open) fail(segment, "ends within the description of its objects");
  if (is_whole) list_data(segment);
  return is_whole;
}

/// Returns false if the description ends within the object.
bool TdmsSegments::take_object(const Segment& segment, Description& description) {
  const std::string_view path = description.text();
  if (description.ended()) return false;
  auto found = by_path_.find(path);
  if (found == by_path_.end()) {
    const auto names = tdms_names(path);
    if (!names)
      fail(segment, "has an object " + shown_bytes(path) + ", expected \"/'group'/'name'\"");
    if (objects_.size() == kMostObjects)
      fail(segment, fmt::format("brings more than {} objects", kMostObjects));
    found = by_path_.emplace(path, objects_.size()).first;
    objects_.emplace_back().names = *names;
  }
  TdmsObject& object = objects_[found->second];
  if (!object.is_listed) listed_.push_back(found->second);
  object.is_listed = true;
  take_index(segment, description, object);
  const std::uint32_t properties = description.word();
  for (std::uint32_t i = 0; i < properties && !description.ended(); ++i) {
    const std::string name(description.text());
    const std::uint32_t type = description.word();
    TdmsProperty property;
    const TdmsType* known = tdms_type(type);
    if (type == kText) {
      property.text = recorded_text(description.text(), file_.file);
    } else if (type == kStamp) {
      property.stamp = description.stamp();
    } else if (known && known->bytes > 0) {
      const std::string_view raw = description.take(known->bytes);
      std::vector<double> number;
      if (!known->fault && !raw.empty())
        append_recorded(raw.data(),
                        0,
                        1,
                        {known->bytes, known->is_real, known->is_signed, segment.is_big_endian},
                        number);
      if (!number.empty()) property.number = number[0];
    } else if (!description.ended()) {
      fail(segment, fmt::format("has a property {} of type {:#x}", shown_bytes(name), type));
    }
    if (!description.ended()) object.properties[name] = std::move(property);
  }
  return !description.ended();
}

/// Reads where the values of an object are in the raw data.
void TdmsSegments::take_index(const Segment& segment,
                              Description& description,
                              TdmsObject& object) {
  const std::uint32_t length = description.word();
  if (description.ended()) return;
  object.has_data = length != kNoData;
  if (length == kNoData) return;
  const std::string name = in_quotes(object.names.empty() ? "/" : object.names.back());
  if (length == kAsBefore) {
    if (!object.index) fail(segment, "repeats the index of " + name + ", which had none before");
    return;
  }
  TdmsIndex index;
  index.type = description.word();
  const std::uint32_t dimension = description.word();
  index.count = description.integer(8);
  const TdmsType* type = tdms_type(index.type);
  index.bytes = index.type == kText ? description.integer(8) : 0;
  if (description.ended()) return;
  if (!type) fail(segment, fmt::format("has values of type {:#x} in {}", index.type, name));
  if (dimension != 1)
    fail(segment, fmt::format("has values of dimension {} in {}, expected 1", dimension, name));
  if (index.count > kMostValues || index.bytes > kMostValues)
    fail(segment, fmt::format("states {} values of {}", index.count, name));
  if (type->bytes == 0 && index.type != kText && index.count > 0)
    fail(segment,
         fmt::format("has values of {} that are not read: {} {}, and their width, by which the "
                     "values of other channels are found, is not known",
                     name,
                     name,
                     type->fault));
  if (type->bytes > 0) index.bytes = index.count * type->bytes;
  object.index = index;
  if (type->fault) object.fault = type->fault;
}

/// Lists the objects that have values in a chunk.
void TdmsSegments::list_data(const Segment& segment) {
  data_.clear();
  chunk_bytes_ = 0;
  for (const std::size_t one : listed_) {
    const TdmsObject& object = objects_[one];
    if (!object.has_data || !object.index || object.index->bytes == 0) continue;
    if (object.names.size() != 2) fail(segment, "has values of an object that is no channel");
    data_.push_back(one);
    chunk_bytes_ += std::min(object.index->bytes, kMostValues);
  }
}

void TdmsSegments::take_data(const Segment& segment) {
  if (!(segment.contents & kHasData) || segment.data_at == segment.end) return;
  if (chunk_bytes_ == 0)
    fail(segment,
         fmt::format("has {} bytes of raw data, but no channel with values",
                     segment.end - segment.data_at));
  const bool is_interleaved = segment.contents & kInterleaved;
  const std::size_t rest = is_interleaved ? take_rows(segment) : take_chunks(segment);
  if (rest > 0)
    doubt(fmt::format(
        "the last {} bytes of the segment at byte {} are not a whole {} and are not read",
        rest,
        segment.at,
        is_interleaved ? "record" : "chunk of its channels"));
}

/// Takes values that stand sample by sample; returns the number of bytes behind the last whole one.
std::size_t TdmsSegments::take_rows(const Segment& segment) {
  std::size_t row = 0;
  for (const std::size_t one : data_) {
    const TdmsIndex& index = *objects_[one].index;
    if (index.type == kText) fail(segment, "has texts between the numbers of its channels");
    if (index.count != objects_[data_.front()].index->count)
      fail(segment, "has interleaved channels with different numbers of values");
    row += tdms_type(index.type)->bytes;
  }
  const std::size_t bytes = segment.end - segment.data_at;
  std::size_t at = segment.data_at;
  for (const std::size_t one : data_) {
    take(segment, one, at, row, bytes / row);
    at += tdms_type(objects_[one].index->type)->bytes;
  }
  return bytes % row;
}

/// Takes values that stand channel by channel; returns the number of bytes behind the last whole
/// chunk.
std::size_t TdmsSegments::take_chunks(const Segment& segment) {
  std::size_t at = segment.data_at;
  while (segment.end - at >= chunk_bytes_)
    for (const std::size_t one : data_) {
      const TdmsIndex& index = *objects_[one].index;
      take(segment, one, at, tdms_type(index.type)->bytes, index.count);
      at += index.bytes;
    }
  const std::size_t rest = segment.end - at;
  const std::size_t width = tdms_type(objects_[data_.front()].index->type)->bytes;
  if (data_.size() > 1 || width == 0) return rest;
  if (rest > 0 && !segment.is_open)
    doubt(
        fmt::format("the last part of the segment at byte {} has {} of the {} values that it "
                    "states",
                    segment.at,
                    rest / width,
                    objects_[data_.front()].index->count));
  take(segment, data_.front(), at, width, rest / width);
  return rest % width;
}

void TdmsSegments::take(const Segment& segment,
                        std::size_t object,
                        std::size_t at,
                        std::size_t stride,
                        std::uint64_t count) {
  TdmsObject& one = objects_[object];
  if (is_counting_) one.count += count;
  if (is_counting_ || !one.fault.empty()) return;
  const TdmsType& type = *tdms_type(one.index->type);
  append_recorded(bytes_.data() + at,
                  stride,
                  count,
                  {type.bytes, type.is_real, type.is_signed, segment.is_big_endian},
                  one.values);
}

}  // namespace latsch::formats
