// SPDX-License-Identifier: Apache-2.0
#include "formats/tire/lost_keys.h"

#include <algorithm>

#include "formats/text/letter_case.h"
#include "formats/tire/tir_file.h"
#include "formats/tire/tir_reader.h"

namespace latsch::formats {

std::vector<std::string> lost_keys(const std::filesystem::path& file, const std::string& exported) {
  if (lower(file.extension().string()) != ".tir") return {};
  const TirFile before = read_tir(file), after = parse_tir(exported, "exported");
  std::vector<std::string> lost;
  for (const TirKey& key : before.keys) {
    const bool is_described = key.section == "UNITS" || key.section == "MDI_HEADER";
    if (!key.parameter.empty() || is_described) continue;
    const bool is_there = std::ranges::any_of(after.keys, [&](const TirKey& one) {
      return one.section == key.section && one.key == key.key;
    });
    if (!is_there)
      lost.push_back(key.key.starts_with('{') ? "the table [" + key.section + "]" : key.key);
  }
  return lost;
}

}  // namespace latsch::formats
