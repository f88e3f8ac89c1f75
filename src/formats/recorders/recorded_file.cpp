// SPDX-License-Identifier: Apache-2.0
#include "formats/recorders/recorded_file.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <set>

#include "base/error.h"
#include "base/mapped_file.h"
#include "base/text.h"
#include "formats/recorders/mdf_file.h"
#include "formats/recorders/motec_file.h"
#include "formats/recorders/rpc_file.h"
#include "formats/recorders/tdms_file.h"
#include "formats/recorders/uff_file.h"
#include "formats/text/file_marks.h"
#include "formats/text/letter_case.h"
#include "formats/text/text_encoding.h"

namespace latsch::formats {
namespace {

constexpr std::size_t kLargestRecorded = std::size_t{2} << 30;  // bytes of a file
constexpr std::size_t kLeastBudget = std::size_t{1} << 30;      // bytes of numbers
constexpr std::size_t kMostNameBytes = 4096;                    // longer names are cut

using RecorderReader = RecordedFile (*)(std::string_view, std::string);

const std::vector<std::pair<std::string, RecorderReader>>& recorder_readers() {
  static const std::vector<std::pair<std::string, RecorderReader>> readers = {{".uff", parse_uff},
                                                                              {".unv", parse_uff},
                                                                              {".uf", parse_uff},
                                                                              {".bunv", parse_uff},
                                                                              {".mf4", parse_mdf},
                                                                              {".mdf", parse_mdf},
                                                                              {".tdms", parse_tdms},
                                                                              {".rsp", parse_rpc},
                                                                              {".drv", parse_rpc},
                                                                              {".tim", parse_rpc},
                                                                              {".rpc", parse_rpc},
                                                                              {".ld", parse_motec}};
  return readers;
}

/// Adds a doubt if the abscissa of a group has a gap or falls back.
void doubt_abscissa(const RecordedGroup& group, RecordedFile& file) {
  const RecordedChannel& abscissa = group.channels.front();
  for (std::size_t i = 0; i < abscissa.values.size(); ++i) {
    const bool is_gap = std::isnan(abscissa.values[i]);
    if (!is_gap && (i == 0 || !(abscissa.values[i] < abscissa.values[i - 1]))) continue;
    file.doubts.push_back(fmt::format("{} of group {} {} at sample {}",
                                      in_quotes(abscissa.name),
                                      in_quotes(group.name),
                                      is_gap ? "is not a number" : "falls back",
                                      i + 1));
    return;
  }
}

}  // namespace

std::vector<std::string> recorder_endings() {
  std::vector<std::string> endings;
  for (const auto& [ending, reader] : recorder_readers()) endings.push_back(ending);
  return endings;
}

RecordedFile read_recorded_file(const std::filesystem::path& file) {
  expect_content_of_ending(file);
  const std::string ending = lower(file.extension().string());
  for (const auto& [known, reader] : recorder_readers()) {
    if (known != ending) continue;
    const MappedFile mapped(file, kLargestRecorded);
    return reader(mapped.text(), file.string());
  }
  throw InputError({file.string(), 0},
                   "ends in " + in_quotes(ending) + ", expected " + list_of(recorder_endings()));
}

NumberBudget::NumberBudget(std::string file, std::size_t bytes_of_file)
    : file_(std::move(file)), left_(std::max(sizeof(double) * bytes_of_file, kLeastBudget)) {}

void NumberBudget::take(std::size_t numbers) {
  if (numbers > left_ / sizeof(double))
    throw InputError({file_, 0},
                     "has channels that need more than eight bytes for each byte of the file, and "
                     "more than 1 GiB: it is damaged, or its recorder should write fewer channels "
                     "into one file");
  left_ -= numbers * sizeof(double);
}

std::string recorded_text(std::string_view bytes, const std::string& file) {
  bytes = bytes.substr(0, std::min(bytes.find('\0'), kMostNameBytes));
  if (bytes.starts_with("\xff\xfe") || bytes.starts_with("\xfe\xff")) bytes.remove_prefix(2);
  std::string plain(bytes);
  for (char& c : plain)
    if (static_cast<unsigned char>(c) < 0x20 || c == 0x7f) c = ' ';
  const std::string text = utf8_text(std::move(plain), file);
  return std::string(trimmed(text));
}

std::string shown_bytes(std::string_view bytes) {
  constexpr std::size_t kMostShown = 20;
  std::string shown = "\"";
  for (const char c : bytes.substr(0, kMostShown)) shown += c >= 0x20 && c < 0x7f ? c : '.';
  return shown + (bytes.size() > kMostShown ? "...\"" : "\"");
}

void tell_equal_names_apart(RecordedGroup& group) {
  std::set<std::string> names;
  std::map<std::string, int> counts;
  for (RecordedChannel& channel : group.channels) {
    const std::string name = channel.name;
    while (!names.insert(channel.name).second)
      channel.name = fmt::format("{} #{}", name, ++counts.try_emplace(name, 1).first->second);
    if (channel.name != name)
      channel.remark = "another channel is called " + in_quotes(name) + " too" +
                       (channel.remark.empty() ? "" : "; " + channel.remark);
  }
}

void check_recorded(RecordedFile& file) {
  std::erase_if(file.groups, [&](const RecordedGroup& group) {
    const bool is_empty = group.channels.empty() || group.samples() == 0;
    if (is_empty && !group.channels.empty())
      file.doubts.push_back("group " + in_quotes(group.name) + " has no sample");
    return is_empty;
  });
  if (file.groups.empty() && !file.left_out.empty())
    throw InputError({file.file, 0},
                     in_quotes(file.left_out.begin()->first) + " " + file.left_out.begin()->second +
                         ", and no other channel is left");
  if (file.groups.empty())
    throw InputError(
        {file.file, 0},
        "has no channel of numbers" + (file.doubts.empty() ? "" : ": " + file.doubts.front()));
  std::set<std::string> names;
  std::map<std::string, int> counts;
  for (RecordedGroup& group : file.groups) {
    tell_equal_names_apart(group);
    const std::string name = group.name;
    while (!names.insert(group.name).second)
      group.name = fmt::format("{} #{}", name, ++counts.try_emplace(name, 1).first->second);
    if (group.has_abscissa) doubt_abscissa(group, file);
  }
}

}  // namespace latsch::formats
