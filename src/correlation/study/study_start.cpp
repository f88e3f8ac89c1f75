// SPDX-License-Identifier: Apache-2.0
#include "correlation/study/study_start.h"

#include <fmt/format.h>

namespace latsch::correlation {
namespace {

constexpr long kMostStarts = 100;

}  // namespace

StartSettings read_start(const Node& table, const std::filesystem::path& folder, bool has_design) {
  using From = StartSettings::From;
  StartSettings start;
  const std::string from = table.choice("start", {"values", "journal", "basins"}, "values");
  if (from == "journal") start.from = From::journal;
  if (from == "basins") start.from = From::basins;
  if (from == "values") {
    for (const char* key : {"starts", "start_journal"}) {
      if (table.has(key)) {
        table.reject(key, "is given without start = \"journal\" or start = \"basins\"");
      }
    }
  }
  if (from == "basins" && !has_design) {
    table.reject("start",
                 "is \"basins\", the minima of a design of experiments, but there is no [doe]; add "
                 "one, such as\n\n    [doe]\n    design = \"latin_hypercube\"\n    points = 40\n");
  }
  start.starts = static_cast<int>(table.integer("starts", 1, kMostStarts, 1));
  if (table.has("start_journal")) {
    if (from != "journal") table.reject("start_journal", "is given without start = \"journal\"");
    start.journal = folder / table.text("start_journal");
    if (!std::filesystem::exists(start.journal)) {
      table.reject("start_journal", "is " + start.journal.string() + ", which does not exist");
    }
  }
  return start;
}

std::string in_words(const StartSettings& start) {
  const std::string several =
      start.starts > 1 ? fmt::format("the {} lowest minima", start.starts) : "";
  switch (start.from) {
    case StartSettings::From::values:
      break;
    case StartSettings::From::journal:
      return fmt::format("{} of the trials in the journal, and knows those near it",
                         several.empty() ? "the best" : several);
    case StartSettings::From::basins:
      return fmt::format("{} of the design of experiments, and knows its points near it",
                         several.empty() ? "the lowest minimum" : several);
  }
  return "";
}

}  // namespace latsch::correlation
