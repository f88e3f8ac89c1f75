// SPDX-License-Identifier: Apache-2.0
#include "cli/console/ledgers.h"

#include <algorithm>
#include <filesystem>
#include <nlohmann/json.hpp>

#include "cli/console/console.h"
#include "correlation/study/ledgers/study_ledgers.h"

namespace latsch::cli {

std::string name_among(const Ledger& ledger, const std::vector<Ledger>& all) {
  const std::filesystem::path file = ledger.file;
  const auto same = std::count_if(all.begin(), all.end(), [&](const Ledger& other) {
    return std::filesystem::path(other.file).filename() == file.filename() &&
           other.file != ledger.file;
  });
  return same == 0 ? file.filename().string() : file.string();
}

std::size_t warn_of_doubts(const std::vector<Ledger>& ledgers) {
  correlation::refuse_doubtful(ledgers);
  std::size_t count = 0;
  for (const Ledger& ledger : ledgers)
    for (const LedgerDoubt& doubt : ledger.doubts) {
      const std::string place = doubt.place.text();
      warn((place.empty() ? "warning: " : "warning: " + place + ": ") + doubt.sentence,
           doubt.place);
      ++count;
    }
  return count;
}

std::size_t say_ledgers(const std::vector<Ledger>& ledgers,
                        bool with_lines,
                        const std::string& title) {
  if (with_lines && !ledgers.empty() && !title.empty()) say("\n{}\n", title);
  for (const Ledger& ledger : ledgers) answer()["ledgers"].push_back(correlation::json_of(ledger));
  if (with_lines)
    for (const Ledger& ledger : ledgers)
      say("  {}: {}\n", name_among(ledger, ledgers), in_one_line(ledger));
  return warn_of_doubts(ledgers);
}

std::size_t say_ledgers(const correlation::Study& study,
                        bool with_lines,
                        const std::string& title) {
  return say_ledgers(correlation::all_ledgers_of(study), with_lines, title);
}

}  // namespace latsch::cli
