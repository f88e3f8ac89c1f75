// SPDX-License-Identifier: Apache-2.0
#include "formats/recorders/mdf_file.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <cstring>
#include <map>
#include <optional>

#include "base/error.h"
#include "base/text.h"
#include "formats/recorders/mdf_blocks.h"
#include "formats/recorders/mdf_data.h"
#include "formats/recorders/mdf_records.h"
#include "formats/recorders/mdf_values.h"

namespace latsch::formats {
namespace {

constexpr std::size_t kIdBlock = 64;  // bytes
constexpr std::size_t kMostChannels = 100000;

class MdfReading {
 public:
  MdfReading(std::string_view bytes, RecordedFile& file)
      : file_(file),
        blocks_(bytes, file.file),
        budget_(file.file, bytes.size()),
        sorting_(file, bytes.size()) {}

  void run() {
    read_id();
    const MdfBlock header = blocks_.at(kIdBlock, "HD");
    if (const std::string comment = blocks_.text(header.link(5)); !comment.empty())
      file_.facts.push_back(comment);
    MdfData data(blocks_, is_unfinished_);
    MdfChain groups;
    for (std::uint64_t at = header.link(0); at != 0;) {
      const MdfBlock block = blocks_.at(at, "DG");
      groups.visit(block);
      take_data_group(block, data);
      at = block.link(0);
    }
    join_remote_masters();
    if (is_unfinished_)
      file_.doubts.push_back(
          "the file was still being written (UnFinMF): it is read up to its last whole record");
  }

 private:
  [[noreturn]] void fail(const std::string& message) const {
    throw InputError({file_.file, 0}, message);
  }

  void read_id() {
    const std::string_view bytes = blocks_.bytes();
    if (bytes.size() < kIdBlock)
      fail(fmt::format("has {} bytes, expected {} or more of an MDF file: it is cut off",
                       bytes.size(),
                       kIdBlock));
    is_unfinished_ = bytes.starts_with("UnFinMF ");
    if (is_unfinished_) sorting_.set_unfinished();
    if (!is_unfinished_ && !bytes.starts_with("MDF     "))
      fail(fmt::format("begins with {}, expected \"MDF     \" or \"UnFinMF \"",
                       shown_bytes(bytes.substr(0, 8))));
    std::uint16_t version = 0;
    std::memcpy(&version, bytes.data() + 28, sizeof(version));
    if (version < 400)
      fail(
          fmt::format("is MDF {}.{:02}, expected 4.0 to 4.2: convert it with the program that "
                      "recorded it",
                      version / 100,
                      version % 100));
    file_.kind = fmt::format("MDF {}.{:02}", version / 100, version % 100);
    if (version >= 500) fail("is " + file_.kind + ", expected 4.0 to 4.2");
    if (version >= 430)
      file_.doubts.push_back("the file is " + file_.kind + " and is read as if it were 4.2");
  }

  MdfGroup group_of(const MdfBlock& block) {
    MdfGroup group;
    group.at = block.at();
    group.first_channel = block.link(1);
    group.name = blocks_.text(block.link(2));
    group.id = block.number<std::uint64_t>(0);
    group.cycles = block.number<std::uint64_t>(8);
    const auto flags = block.number<std::uint16_t>(16);
    group.data_bytes = block.number<std::uint32_t>(24);
    group.invalid_bytes = block.number<std::uint32_t>(28);
    group.is_vlsd = flags & 1;
    group.is_bus = flags & 2;
    if (flags & 8) group.master_at = block.link(6);
    ++group_count_;
    if (group.name.empty()) group.name = fmt::format("group {}", group_count_);
    return group;
  }

  void take_data_group(const MdfBlock& block, MdfData& data) {
    const auto id_bytes = block.number<std::uint8_t>(0);
    if (id_bytes > 8)
      block.fail(fmt::format("has record ids of {} bytes, expected up to 8", id_bytes));
    std::vector<MdfGroup> groups;
    MdfChain chain;
    for (std::uint64_t at = block.link(1); at != 0;) {
      const MdfBlock group = blocks_.at(at, "CG");
      chain.visit(group);
      groups.push_back(group_of(group));
      at = group.link(0);
    }
    if (groups.empty()) return;
    if (id_bytes == 0 && groups.size() > 1)
      block.fail(fmt::format("has {} channel groups, but no record ids", groups.size()));
    const MdfBytes bytes = data.read(block.link(2));
    std::vector<MdfRecords> records(groups.size());
    if (id_bytes == 0) {
      records[0].in_file = bytes.view();
    } else {
      sorting_.sort(bytes.view(), id_bytes, groups, block, records);
    }
    for (std::size_t i = 0; i < groups.size(); ++i) take_group(groups[i], records[i]);
  }

  void take_group(const MdfGroup& group, MdfRecords& records) {
    if (group.is_vlsd) return;  // values of the channels that the other groups name
    if (group.is_bus) {
      leave_out(group.name, "holds frames of a bus: convert them to channels first");
      return;
    }
    sorting_.count(group, records);
    RecordedGroup read{group.name, {}, false};
    MdfChain chain;
    for (std::uint64_t at = group.first_channel; at != 0;) {
      const MdfBlock block = blocks_.at(at, "CN");
      chain.visit(block);
      if (++channel_count_ > kMostChannels)
        block.fail(fmt::format("is more than the {}th channel", kMostChannels));
      take_channel(block, group, records, read);
      at = block.link(0);
    }
    if (group.master_at != 0) remote_.push_back({file_.groups.size(), group.master_at});
    groups_at_[group.at] = file_.groups.size();
    file_.groups.push_back(std::move(read));
  }

  void leave_out(const std::string& name, const std::string& why) {
    file_.left_out.insert({name, why});
  }

  /// Returns why a channel is not read; empty if it is.
  static std::string fault_of(const MdfBlock& block, const MdfBlocks& blocks) {
    const int type = block.number<std::uint8_t>(0), data = block.number<std::uint8_t>(2);
    if (type == 1 || type == 5) return "has values of variable length";
    if (type == 4) return "refers to samples of another file";
    if (type > 6) return fmt::format("is of type {}, which is unknown", type);
    if (data >= 6 && data <= 9) return "has texts";
    if (data >= 10 && data <= 12) return "has bytes and no numbers";
    if (data == 13 || data == 14) return "has dates and no numbers";
    if (data == 15 || data == 16) return "has complex numbers";
    if (data > 16) return fmt::format("has numbers of type {}, which is unknown", data);
    if (block.link(1) != 0)
      return blocks.at(block.link(1)).id() == "CA" ? "is an array" : "is a structure of channels";
    return "";
  }

  static std::optional<MdfField> field_of(const MdfBlock& block, std::string& fault) {
    MdfField field;
    const int data = block.number<std::uint8_t>(2);
    field.is_big_endian = data % 2 == 1;
    field.is_signed = data == 2 || data == 3;
    field.is_real = data == 4 || data == 5;
    field.bit = block.number<std::uint8_t>(3);
    field.byte = block.number<std::uint32_t>(4);
    field.bits = block.number<std::uint32_t>(8);
    if (field.bits == 0 || field.bits > 64 ||
        (field.is_real && field.bits != 16 && field.bits != 32 && field.bits != 64)) {
      fault = fmt::format("has numbers of {} bits, expected {}",
                          field.bits,
                          field.is_real ? "16, 32 or 64" : "1 to 64");
      return std::nullopt;
    }
    if (field.bit > 7) {
      fault = fmt::format("begins at bit {} of a byte", field.bit);
      return std::nullopt;
    }
    return field;
  }

  void take_channel(const MdfBlock& block,
                    const MdfGroup& group,
                    const MdfRecords& records,
                    RecordedGroup& read) {
    std::string name = blocks_.text(block.link(2));
    if (name.empty()) name = fmt::format("channel {}", channel_count_);
    if (std::string fault = fault_of(block, blocks_); !fault.empty()) return leave_out(name, fault);
    const MdfRule rule = mdf_rule(blocks_, block.link(4));
    if (!rule.fault.empty()) return leave_out(name, rule.fault);
    RecordedChannel channel{name, blocks_.text(block.link(6))};
    if (channel.unit.empty() && block.link(4) != 0)
      channel.unit = blocks_.text(blocks_.at(block.link(4), "CC").link(1));
    const int type = block.number<std::uint8_t>(0);
    const bool is_virtual = type == 3 || type == 6;
    bool is_integer = true;
    if (is_virtual) {
      budget_.take(records.count);
      channel.values.resize(records.count);
      for (std::size_t i = 0; i < records.count; ++i) channel.values[i] = static_cast<double>(i);
    } else {
      std::string fault;
      const auto field = field_of(block, fault);
      if (!field) return leave_out(name, fault);
      if (field->bytes() > group.data_bytes || field->byte > group.data_bytes - field->bytes())
        block.fail(fmt::format("has {} at bytes {} to {} of a record of {} bytes",
                               in_quotes(name),
                               field->byte,
                               field->byte + field->bytes(),
                               group.data_bytes));
      budget_.take(records.count);
      channel.values = mdf_numbers(records.view(), group.record(), records.count, *field);
      is_integer = !field->is_real;
    }
    if (const auto scale = natural_integers(channel.values, rule, is_integer); !scale.empty())
      channel.remark = scale;
    convert_mdf(rule, is_integer, channel.values);
    for (double& value : channel.values)
      if (!std::isfinite(value)) value = std::nan("");
    mark_invalid(block, group, records, channel);
    add(block, type == 2 || type == 3, std::move(channel), read);
  }

  /// Says if integers are larger than the numbers that are exact in double precision.
  static std::string natural_integers(const std::vector<double>& raw,
                                      const MdfRule& rule,
                                      bool is_integer) {
    constexpr double kExact = 9007199254740992.0;  // 2^53
    if (!is_integer || rule.type > 1) return "";
    const bool is_large =
        std::any_of(raw.begin(), raw.end(), [](double value) { return std::abs(value) > kExact; });
    return is_large ? "has integers above 2^53, which are rounded" : "";
  }

  /// Makes gaps of the samples that the invalidation bits mark.
  void mark_invalid(const MdfBlock& block,
                    const MdfGroup& group,
                    const MdfRecords& records,
                    RecordedChannel& channel) const {
    const auto flags = block.number<std::uint32_t>(12);
    if (flags & 1) std::fill(channel.values.begin(), channel.values.end(), std::nan(""));
    if (!(flags & 2) || group.invalid_bytes == 0) return;
    const std::size_t bit = block.number<std::uint32_t>(16);
    if (bit / 8 >= group.invalid_bytes)
      block.fail(fmt::format("has invalidation bit {} of {} bytes", bit, group.invalid_bytes));
    if (records.view().size() < records.count * group.record()) return;
    const char* at = records.view().data() + group.data_bytes + bit / 8;
    for (std::size_t i = 0; i < records.count; ++i)
      if (at[i * group.record()] >> (bit % 8) & 1) channel.values[i] = std::nan("");
  }

  /// Adds a channel to its group; the master of time or angle stands first.
  static void add(const MdfBlock& block,
                  bool is_master,
                  RecordedChannel channel,
                  RecordedGroup& read) {
    if (!is_master || read.has_abscissa) {
      read.channels.push_back(std::move(channel));
      return;
    }
    if (block.number<std::uint8_t>(1) == 1) {
      if (channel.name != "time") {
        channel.remark = "is called " + in_quotes(channel.name) + " in the file" +
                         (channel.remark.empty() ? "" : "; " + channel.remark);
        channel.name = "time";
      }
      if (channel.unit.empty()) channel.unit = "s";
    }
    read.has_abscissa = true;
    read.channels.insert(read.channels.begin(), std::move(channel));
  }

  /// Moves channels whose master is in another group to that group.
  void join_remote_masters() {
    for (const auto& [index, master_at] : remote_) {
      RecordedGroup& from = file_.groups[index];
      const auto found = groups_at_.find(master_at);
      if (found == groups_at_.end() || found->second == index) continue;
      RecordedGroup& to = file_.groups[found->second];
      if (from.has_abscissa || to.samples() != from.samples()) {
        file_.doubts.push_back(fmt::format(
            "group {} has {} samples and its master in group {}, which has {}: it stays alone",
            in_quotes(from.name),
            from.samples(),
            in_quotes(to.name),
            to.samples()));
        continue;
      }
      for (RecordedChannel& channel : from.channels) to.channels.push_back(std::move(channel));
      from.channels.clear();
    }
  }

  struct Remote {
    std::size_t group;
    std::uint64_t master_at;
  };

  RecordedFile& file_;
  MdfBlocks blocks_;
  NumberBudget budget_;
  MdfRecordSorting sorting_;
  bool is_unfinished_ = false;
  int group_count_ = 0;
  std::size_t channel_count_ = 0;
  std::vector<Remote> remote_;
  std::map<std::uint64_t, std::size_t> groups_at_;
};

}  // namespace

RecordedFile parse_mdf(std::string_view bytes, std::string file) {
  RecordedFile result;
  result.file = std::move(file);
  MdfReading(bytes, result).run();
  check_recorded(result);
  return result;
}

}  // namespace latsch::formats
