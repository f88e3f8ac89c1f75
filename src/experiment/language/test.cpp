// SPDX-License-Identifier: Apache-2.0
#include "experiment/language/test.h"

#include "base/document_record.h"
#include "experiment/language/sign_view.h"

namespace latsch::experiment {

ChannelInfo slope_of(const std::string& moved, const std::string& unit, const SlopesBy& slopes) {
  ChannelInfo info{slopes.name(moved), slopes.unit_of(unit)};
  info.regression = Regression{moved, unit, slopes};
  return info;
}

std::filesystem::path TestSource::file(const Node& table, std::string_view key) const {
  std::filesystem::path named = folder / table.text(key);
  DocumentRecord::names_files(table, key, {named});
  return named;
}

std::optional<long> Test::samples_of(const std::string& channel) const {
  for (const ChannelInfo& one : channels())
    if (one.name == channel && one.regression) return 1;
  return samples();
}

Result<std::vector<std::string>> Test::run_in_blocks(
    Specimen& specimen, const std::function<void(const Channels&)>& tell) const {
  const auto all = run(specimen);
  if (!all) return all.failure();
  tell(*all);
  return std::vector<std::string>();
}

Result<Test::Details> Test::details_in(suspension::SignView view, Specimen& specimen) const {
  auto found = details(specimen);
  if (found) found->numbers = in_signs(found->numbers, *this, view);
  return found;
}

}  // namespace latsch::experiment
