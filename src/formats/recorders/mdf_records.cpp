// SPDX-License-Identifier: Apache-2.0
#include "formats/recorders/mdf_records.h"

#include <fmt/format.h>

#include <cstring>
#include <map>

#include "base/error.h"
#include "base/text.h"

namespace latsch::formats {

void MdfRecordSorting::fail(const std::string& message) const {
  throw InputError({file_.file, 0}, message);
}

void MdfRecordSorting::sort(std::string_view bytes,
                            std::size_t id_bytes,
                            const std::vector<MdfGroup>& groups,
                            const MdfBlock& block,
                            std::vector<MdfRecords>& records) {
  std::map<std::uint64_t, std::size_t> by_id;
  for (std::size_t i = 0; i < groups.size(); ++i)
    if (!by_id.insert({groups[i].id, i}).second)
      block.fail(fmt::format("has two channel groups of record id {}", groups[i].id));
  while (bytes.size() >= id_bytes && !bytes.empty()) {
    std::uint64_t id = 0;
    std::memcpy(&id, bytes.data(), id_bytes);
    const auto found = by_id.find(id);
    if (found == by_id.end())
      block.fail(fmt::format("has a record of id {}, which is no channel group of it", id));
    bytes.remove_prefix(id_bytes);
    const MdfGroup& group = groups[found->second];
    std::size_t size = group.record();
    if (group.is_vlsd) {
      std::uint32_t length = 0;
      if (bytes.size() < sizeof(length)) break;
      std::memcpy(&length, bytes.data(), sizeof(length));
      size = sizeof(length) + length;
    }
    if (bytes.size() < size) {
      cut_off(group);
      for (MdfRecords& one : records) one.is_cut = true;
      break;
    }
    if (!group.is_vlsd) records[found->second].copy += bytes.substr(0, size);
    bytes.remove_prefix(size);
  }
}

void MdfRecordSorting::cut_off(const MdfGroup& group) {
  if (!is_unfinished_)
    file_.doubts.push_back("the last record of group " + in_quotes(group.name) +
                           " is cut off and is not read");
}

void MdfRecordSorting::count(const MdfGroup& group, MdfRecords& records) {
  const std::size_t bytes = records.view().size(), size = group.record();
  if (size == 0) {
    if (bytes > 0) fail(fmt::format("has group {} with a record size of 0", in_quotes(group.name)));
    // virtual channels alone: they need no bytes, but every number of theirs counts as memory
    if (group.cycles > bytes_of_file_)
      fail(fmt::format(
          "has group {} with {} records of 0 bytes", in_quotes(group.name), group.cycles));
    records.count = group.cycles;
    return;
  }
  const std::size_t whole = bytes / size;
  if (is_unfinished_ || records.is_cut || (group.cycles == 0 && whole > 0)) {
    records.count = whole;
    if (!is_unfinished_ && !records.is_cut)
      file_.doubts.push_back(fmt::format(
          "group {} states 0 records, but has {}: they are read", in_quotes(group.name), whole));
    return;
  }
  if (whole < group.cycles)
    fail(fmt::format("has {} records of group {}, expected {}: is the file cut off?",
                     whole,
                     in_quotes(group.name),
                     group.cycles));
  records.count = group.cycles;
  if (whole > group.cycles)
    file_.doubts.push_back(fmt::format("group {} has {} records, but states {}: those are read",
                                       in_quotes(group.name),
                                       whole,
                                       group.cycles));
}

}  // namespace latsch::formats
