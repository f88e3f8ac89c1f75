// SPDX-License-Identifier: Apache-2.0
#include "formats/recorders/motec_file.h"

#include <fmt/format.h>

#include <cmath>
#include <set>

#include "base/error.h"
#include "base/text.h"
#include "formats/recorders/recorded_numbers.h"

namespace latsch::formats {
namespace {

constexpr std::size_t kMotecHead = 0x15e + 64;  // bytes up to the end of the venue
constexpr std::size_t kMotecBlock = 84;         // bytes of a channel block that are read
constexpr std::uint32_t kMotecMark = 0x40;      // the first number of a file

/// A channel block.
struct MotecChannel {
  std::size_t at = 0, next = 0, data = 0, count = 0;
  unsigned kind = 0, bytes = 0, rate = 0;
  int shift = 0, multiplier = 0, scale = 0, decimals = 0;
  std::string name, unit;
  bool is_real() const { return kind == 7; }
};

class MotecReading {
 public:
  MotecReading(std::string_view bytes, RecordedFile& file)
      : bytes_(bytes), file_(file), budget_(file.file, bytes.size()) {}

  void run() {
    if (bytes_.size() < kMotecHead)
      throw InputError({file_.file, 0},
                       fmt::format("has {} bytes, expected the header of a MoTeC log of {} or "
                                   "more: the file is cut off",
                                   bytes_.size(),
                                   static_cast<std::size_t>(kMotecHead)));
    if (integer(0, 4) != kMotecMark)
      throw InputError({file_.file, 0},
                       fmt::format("begins with {}, expected the header of a MoTeC log, which "
                                   "begins with the number 64",
                                   shown_bytes(bytes_.substr(0, 4))));
    constexpr std::pair<const char*, std::size_t> kTexts[] = {
        {"date", 0x5e}, {"time", 0x7e}, {"driver", 0x9e}, {"vehicle", 0xde}, {"venue", 0x15e}};
    for (const auto& [what, at] : kTexts)
      if (const std::string text =
              recorded_text(bytes_.substr(at, at < 0x9e ? 16 : 64), file_.file);
          !text.empty())
        file_.facts.push_back(fmt::format("{}: {}", what, text));
    std::set<std::size_t> seen;
    for (std::size_t at = integer(8, 4); at != 0;) {
      const MotecChannel channel = block(at);
      if (!seen.insert(at).second) fail(at, "is linked twice: its chain has no end");
      take(channel);
      at = channel.next;
    }
    file_.doubts.push_back(
        "the format .ld has no public text, and its reader is experimental: compare some values "
        "with those that the logger's own program shows");
  }

 private:
  [[noreturn]] void fail(std::size_t at, const std::string& message) const {
    throw InputError({file_.file, 0}, fmt::format("channel block at byte {} {}", at, message));
  }
  std::size_t integer(std::size_t at, unsigned bytes) const {
    return static_cast<std::size_t>(recorded_integer(bytes_.data() + at, bytes, false));
  }
  int short_integer(std::size_t at) const { return static_cast<std::int16_t>(integer(at, 2)); }

  MotecChannel block(std::size_t at) const {
    if (at > bytes_.size() || bytes_.size() - at < kMotecBlock)
      fail(at,
           fmt::format("is behind the end of the file, which has {} bytes: the file is cut off",
                       bytes_.size()));
    MotecChannel channel;
    channel.at = at;
    channel.next = integer(at + 4, 4);
    channel.data = integer(at + 8, 4);
    channel.count = integer(at + 12, 4);
    channel.kind = static_cast<unsigned>(integer(at + 18, 2));
    channel.bytes = static_cast<unsigned>(integer(at + 20, 2));
    channel.rate = static_cast<unsigned>(integer(at + 22, 2));
    channel.shift = short_integer(at + 24);
    channel.multiplier = short_integer(at + 26);
    channel.scale = short_integer(at + 28);
    channel.decimals = short_integer(at + 30);
    channel.name = recorded_text(bytes_.substr(at + 32, 32), file_.file);
    channel.unit = recorded_text(bytes_.substr(at + 72, 12), file_.file);
    if (channel.name.empty()) channel.name = fmt::format("channel at byte {}", at);
    return channel;
  }

  /// Returns why a channel is left out, to follow its name; empty if it is read.
  static std::string fault_of(const MotecChannel& channel) {
    const bool is_known =
        channel.kind == 0 || channel.kind == 3 || channel.kind == 5 || channel.kind == 7;
    if (!is_known)
      return fmt::format("has numbers of kind {}, expected 0, 3, 5 or 7", channel.kind);
    if (channel.bytes != 2 && channel.bytes != 4)
      return fmt::format("has numbers of {} bytes, expected 2 or 4", channel.bytes);
    if (channel.rate == 0) return "has a rate of 0 Hz";
    if (channel.scale == 0) return "has a scale of 0";
    if (channel.multiplier == 0) return "has a multiplier of 0";
    return "";
  }

  void take(const MotecChannel& channel) {
    if (const std::string fault = fault_of(channel); !fault.empty()) {
      file_.left_out[channel.name] = fault;
      return;
    }
    const std::size_t begin = std::min(channel.data, bytes_.size());
    std::size_t count = channel.count;
    if (const std::size_t whole = (bytes_.size() - begin) / channel.bytes; whole < count) {
      file_.doubts.push_back(
          fmt::format("the file is cut off: channel {} has {} of {} samples, and those are read",
                      in_quotes(channel.name),
                      whole,
                      count));
      count = whole;
    }
    if (count == 0) {
      file_.doubts.push_back("channel " + in_quotes(channel.name) + " has no sample");
      return;
    }
    // Blocks may point to numbers of others; every one counts as memory all the same.
    budget_.take(count);
    RecordedChannel read{channel.name, channel.unit};
    append_recorded(bytes_.data() + begin,
                    channel.bytes,
                    count,
                    {channel.bytes, channel.is_real(), true, false},
                    read.values);
    const double power = std::pow(10.0, -channel.decimals);
    for (double& value : read.values) {
      value = (value / channel.scale * power + channel.shift) * channel.multiplier;
      if (!std::isfinite(value)) value = std::nan("");
    }
    group_of(channel.rate, count).channels.push_back(std::move(read));
  }

  RecordedGroup& group_of(unsigned rate, std::size_t samples) {
    const auto [found, is_new] = groups_.try_emplace({rate, samples}, file_.groups.size());
    if (!is_new) return file_.groups[found->second];
    budget_.take(samples);
    RecordedChannel time{"time", "s"};
    for (std::size_t i = 0; i < samples; ++i) time.values.push_back(static_cast<double>(i) / rate);
    file_.groups.push_back({fmt::format("{} Hz", rate), {std::move(time)}, true});
    return file_.groups.back();
  }

  std::string_view bytes_;
  RecordedFile& file_;
  NumberBudget budget_;
  std::map<std::pair<unsigned, std::size_t>, std::size_t> groups_;
};

}  // namespace

RecordedFile parse_motec(std::string_view bytes, std::string file) {
  RecordedFile result;
  result.file = std::move(file);
  result.kind = "MoTeC log (experimental)";
  MotecReading(bytes, result).run();
  check_recorded(result);
  return result;
}

}  // namespace latsch::formats
