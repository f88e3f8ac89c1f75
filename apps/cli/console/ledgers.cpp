// SPDX-License-Identifier: Apache-2.0
#include "cli/console/ledgers.h"

#include <filesystem>
#include <nlohmann/json.hpp>

#include "cli/console/console.h"
#include "correlation/study/ledgers/study_ledgers.h"

namespace latsch::cli {

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

std::size_t say_ledgers(const correlation::Study& study,
                        bool with_lines,
                        const std::string& title) {
  const auto ledgers = correlation::all_ledgers_of(study);
  if (with_lines && !ledgers.empty() && !title.empty()) say("\n{}\n", title);
  for (const Ledger& ledger : ledgers) answer()["ledgers"].push_back(correlation::json_of(ledger));
  if (with_lines)
    for (const Ledger& ledger : ledgers)
      say("  {}: {}\n",
          std::filesystem::path(ledger.file).filename().string(),
          in_one_line(ledger));
  return warn_of_doubts(ledgers);
}

}  // namespace latsch::cli
