// SPDX-License-Identifier: Apache-2.0
#include "formats/recorders/rpc_file.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <optional>

#include "base/error.h"
#include "base/text.h"
#include "formats/recorders/recorded_numbers.h"

namespace latsch::formats {
namespace {

constexpr std::size_t kRpcBlock = 512, kRpcRecord = 128, kRpcKeyword = 32;  // bytes
constexpr double kMostRpcFrames = 1e9;
constexpr double kMostRpcChannels = 1024;  // the format's text allows 128, its programs 256

/// The records of a header.
class RpcHeader {
 public:
  RpcHeader(std::string_view bytes, const std::string& file) : file_(file) {
    if (bytes.size() < kRpcBlock)
      fail(fmt::format("has {} bytes, expected a header block of 512 or more: the file is cut off",
                       bytes.size()));
    if (key_at(bytes, 0) != "FORMAT")
      fail(fmt::format("begins with {}, expected the keyword \"FORMAT\" of an RPC III file",
                       shown_bytes(bytes.substr(0, 8))));
    for (std::size_t i = 0; i < 3; ++i) take(bytes, i);
    const double blocks = number("NUM_HEADER_BLOCKS", 1.0, 1e6);
    if (blocks * kRpcBlock > static_cast<double>(bytes.size()))
      fail(
          fmt::format("states {:.0f} header blocks of 512 bytes, but has {} bytes: the file is "
                      "cut off",
                      blocks,
                      bytes.size()));
    size_ = static_cast<std::size_t>(blocks) * kRpcBlock;
    const double records = number("NUM_PARAMS", 3.0, blocks * 4.0);
    for (std::size_t i = 3; i < static_cast<std::size_t>(records); ++i) take(bytes, i);
  }

  [[noreturn]] void fail(const std::string& message) const {
    throw InputError({file_, 0}, message);
  }
  std::size_t size() const { return size_; }
  /// Returns the value of a keyword; empty if there is none.
  std::string text(const std::string& key) const {
    const auto found = records_.find(key);
    return found == records_.end() ? std::string() : found->second;
  }
  bool has(const std::string& key) const { return !text(key).empty(); }
  double number(const std::string& key, double least, double most) const {
    if (!has(key)) fail("has no " + key + " in its header");
    const auto value = parse_number(text(key));
    if (!value || !(*value >= least) || !(*value <= most))
      fail(fmt::format("has {} = {}, expected a number from {:g} to {:g}",
                       key,
                       in_quotes(text(key)),
                       least,
                       most));
    return *value;
  }
  std::size_t count(const std::string& key, double most) const {
    const double value = number(key, 1.0, most);
    if (value != std::floor(value)) fail(key + " is " + in_quotes(text(key)) + ", no whole number");
    return static_cast<std::size_t>(value);
  }

 private:
  std::string_view key_at(std::string_view bytes, std::size_t record) const {
    const std::string_view key = bytes.substr(record * kRpcRecord, kRpcKeyword);
    return trimmed(key.substr(0, key.find('\0')));
  }
  void take(std::string_view bytes, std::size_t record) {
    const std::string key(key_at(bytes, record));
    const auto value = recorded_text(
        bytes.substr(record * kRpcRecord + kRpcKeyword, kRpcRecord - kRpcKeyword), file_);
    if (!key.empty()) records_.try_emplace(key, unquoted(value));
  }
  static std::string unquoted(const std::string& text) {
    const bool is_quoted = text.size() > 1 && text.starts_with('"') && text.ends_with('"');
    return is_quoted ? std::string(trimmed(text.substr(1, text.size() - 2))) : text;
  }

  const std::string& file_;
  std::size_t size_ = 0;  // bytes
  std::map<std::string, std::string> records_;
};

/// Layout of the samples in the file.
struct RpcLayout {
  RecordedKind kind;
  std::size_t channels = 0, frame = 0, group = 0, frames = 0;  // frame, group: samples
  double step = 0.0;                                           // s
  std::size_t samples() const { return frames * frame; }
  /// Bytes of a group of `of` samples of each channel.
  std::size_t bytes(std::size_t of) const { return of * channels * kind.bytes; }
};

void refuse_other_kinds(const RpcHeader& header) {
  const std::string format = header.text("FORMAT");
  if (format != "BINARY" && format != "BINARY_IEEE_LITTLE_END" && format != "BINARY_IEEE_BIG_END")
    header.fail("has FORMAT = " + in_quotes(format) +
                ", expected BINARY, BINARY_IEEE_LITTLE_END or BINARY_IEEE_BIG_END");
  if (header.has("FILE_TYPE") && header.text("FILE_TYPE") != "TIME_HISTORY")
    header.fail("has FILE_TYPE = " + in_quotes(header.text("FILE_TYPE")) +
                ", expected TIME_HISTORY");
  const std::string type = header.text("TIME_TYPE");
  if (!type.empty() && type != "DRIVE" && type != "RESPONSE" && type != "1" && type != "2")
    header.fail("has TIME_TYPE = " + in_quotes(type) +
                ", expected DRIVE or RESPONSE: configurations hold no samples, multiplexed and "
                "peak-picked histories are not read");
  if (const std::string half = header.text("HALF_FRAMES"); !half.empty() && half != "0")
    header.fail("has HALF_FRAMES = " + in_quotes(half) +
                ", expected 0: write the history without half frames");
}

RpcLayout rpc_layout(const RpcHeader& header, std::size_t bytes, RecordedFile& file) {
  RpcLayout layout;
  std::string type = header.text("DATA_TYPE");
  if (type.empty()) {
    file.facts.push_back("DATA_TYPE is not stated: SHORT_INTEGER is taken");
    type = "SHORT_INTEGER";
  }
  if (type != "SHORT_INTEGER" && type != "FLOATING_POINT")
    header.fail("has DATA_TYPE = " + in_quotes(type) +
                ", expected SHORT_INTEGER or FLOATING_POINT");
  const bool is_real = type == "FLOATING_POINT";
  layout.kind = {is_real ? 4u : 2u, is_real, true, header.text("FORMAT") == "BINARY_IEEE_BIG_END"};
  layout.channels = header.count("CHANNELS", kMostRpcChannels);
  const double most = static_cast<double>(bytes);
  layout.frame = header.count("PTS_PER_FRAME", most);
  layout.group = header.count("PTS_PER_GROUP", most);
  layout.frames = header.count("FRAMES", kMostRpcFrames);
  layout.step = header.number("DELTA_T", 0.0, 1e9);
  if (!(layout.step > 0.0)) header.fail("has DELTA_T = 0, expected a time above 0 s");
  if (layout.group % layout.frame != 0)
    header.fail(fmt::format("has groups of {} samples, expected a multiple of a frame's {}",
                            layout.group,
                            layout.frame));
  return layout;
}

class RpcReading {
 public:
  RpcReading(std::string_view bytes, RecordedFile& file)
      : header_(bytes, file.file),
        data_(bytes.substr(header_.size())),
        file_(file),
        budget_(file.file, bytes.size()) {
    refuse_other_kinds(header_);
    layout_ = rpc_layout(header_, bytes.size(), file);
  }

  void run() {
    for (const char* key : {"DATE", "OPERATION", "TIME_TYPE"})
      if (header_.has(key)) file_.facts.push_back(fmt::format("{}: {}", key, header_.text(key)));
    std::vector<std::size_t> groups = group_lengths();  // samples of each group in the file
    RecordedGroup group{"time history", {}, true};
    group.channels.push_back({"time", "s"});
    for (std::size_t i = 0; i < layout_.channels; ++i) group.channels.push_back(channel(i, groups));
    std::size_t samples = std::min(stored_, layout_.samples());
    samples = without_filling(group, samples);
    budget_.take(samples);
    for (std::size_t i = 0; i < samples; ++i)
      group.channels.front().values.push_back(static_cast<double>(i) * layout_.step);
    for (RecordedChannel& one : group.channels) one.values.resize(samples);
    file_.groups.push_back(std::move(group));
  }

 private:
  /// Returns the samples of each group that the file holds whole.
  std::vector<std::size_t> group_lengths() {
    const std::size_t wanted = (layout_.samples() + layout_.group - 1) / layout_.group;
    const std::size_t whole = std::min(wanted, data_.size() / layout_.bytes(layout_.group));
    std::vector<std::size_t> lengths(whole, layout_.group);
    std::size_t used = whole * layout_.bytes(layout_.group);
    const std::size_t rest = layout_.samples() - std::min(layout_.samples(), whole * layout_.group);
    if (whole < wanted && whole + 1 == wanted && rest < layout_.group &&
        data_.size() - used == layout_.bytes(rest)) {
      lengths.push_back(rest);
      used = data_.size();
      file_.doubts.push_back(fmt::format(
          "the last group has {} samples of each channel instead of {}: it is read as not filled "
          "up",
          rest,
          layout_.group));
    } else if (whole < wanted) {
      file_.doubts.push_back(fmt::format(
          "the file is cut off: it has {} of {} groups of {} samples, and the bytes behind them "
          "are not read",
          whole,
          wanted,
          layout_.group));
    }
    if (lengths.empty())
      header_.fail(fmt::format("has {} bytes of data, expected {} for its first group",
                               data_.size(),
                               layout_.bytes(layout_.group)));
    if (whole == wanted && data_.size() > used)
      file_.doubts.push_back(fmt::format("the last {} bytes belong to no group and are not read",
                                         data_.size() - used));
    for (const std::size_t length : lengths) stored_ += length;
    return lengths;
  }

  RecordedChannel channel(std::size_t index, const std::vector<std::size_t>& groups) {
    const std::string suffix = fmt::format(".CHAN_{}", index + 1);
    RecordedChannel channel{header_.text("DESC" + suffix), header_.text("UNITS" + suffix)};
    if (channel.name.empty()) channel.name = fmt::format("channel {}", index + 1);
    double scale = 1.0;
    if (!layout_.kind.is_real) {
      scale = header_.number("SCALE" + suffix, -1e300, 1e300);
      if (scale == 0.0) header_.fail("has SCALE" + suffix + " = 0, expected another number");
    } else if (const auto stated = parse_number(header_.text("SCALE" + suffix));
               stated && *stated != 1.0) {
      channel.remark = "SCALE is not applied to floating-point numbers";
    }
    budget_.take(stored_);
    channel.values.reserve(stored_);
    const char* at = data_.data();
    for (const std::size_t length : groups) {
      append_recorded(at + index * length * layout_.kind.bytes,
                      layout_.kind.bytes,
                      length,
                      layout_.kind,
                      channel.values);
      at += layout_.bytes(length);
    }
    for (double& value : channel.values) {
      value *= scale;
      if (!std::isfinite(value)) value = std::nan("");
    }
    return channel;
  }

  /// Returns the number of samples without those that fill up the last group.
  std::size_t without_filling(const RecordedGroup& group, std::size_t samples) {
    if (header_.has("SAMPLES")) {
      const std::size_t stated = header_.count("SAMPLES", 1e15);
      file_.facts.push_back(fmt::format("SAMPLES states {} samples", stated));
      return std::min(samples, stated);
    }
    const std::size_t least = (samples - 1) / layout_.group * layout_.group;
    std::size_t end = samples;
    const auto is_zero = [&](std::size_t i) {
      return std::all_of(group.channels.begin() + 1, group.channels.end(), [&](const auto& one) {
        return one.values[i] == 0.0;
      });
    };
    while (end > least && end > 1 && is_zero(end - 1)) --end;
    if (end < samples)
      file_.doubts.push_back(fmt::format(
          "every channel is 0 in the last {} samples, which fill up the last group: they are not "
          "read",
          samples - end));
    return end;
  }

  RpcHeader header_;
  std::string_view data_;
  RecordedFile& file_;
  NumberBudget budget_;
  RpcLayout layout_;
  std::size_t stored_ = 0;  // samples of each channel in the file
};

}  // namespace

RecordedFile parse_rpc(std::string_view bytes, std::string file) {
  RecordedFile result;
  result.file = std::move(file);
  result.kind = "RPC III time history";
  RpcReading(bytes, result).run();
  check_recorded(result);
  return result;
}

}  // namespace latsch::formats
