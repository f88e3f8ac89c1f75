// SPDX-License-Identifier: Apache-2.0
#include "cli/console/ledgers.h"

#include <fmt/format.h>

#include <algorithm>
#include <filesystem>
#include <nlohmann/json.hpp>

#include "cli/console/console.h"
#include "correlation/study/ledgers/file_ledgers.h"
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

namespace {

/// True if the reader of the file assumed something, ignored something or doubts something.
bool leaves_something_open(const Ledger& ledger) {
  return !ledger.doubts.empty() ||
         std::any_of(ledger.rows.begin(), ledger.rows.end(), [](const LedgerRow& row) {
           return row.state != LedgerState::used;
         });
}

}  // namespace

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
  return say_ledgers(
      correlation::all_ledgers_of(study), with_lines ? LinesTo::output : LinesTo::nowhere, title);
}

std::size_t say_ledgers(const std::vector<Ledger>& ledgers, LinesTo to, const std::string& title) {
  for (const Ledger& ledger : ledgers) answer()["ledgers"].push_back(correlation::json_of(ledger));
  std::string lines;
  for (const Ledger& ledger : ledgers)
    if (to != LinesTo::standard_error || leaves_something_open(ledger))
      lines += fmt::format("  {}: {}\n", name_among(ledger, ledgers), in_one_line(ledger));
  if (!lines.empty() && !title.empty()) lines = fmt::format("\n{}\n{}", title, lines);
  if (to == LinesTo::output) say_text(lines);
  if (to == LinesTo::standard_error) note_text(lines);
  return warn_of_doubts(ledgers);
}

std::vector<Ledger> ledgers_of_test(const std::string& model,
                                    const std::string& test,
                                    const std::vector<std::filesystem::path>& test_files,
                                    std::vector<Ledger> known) {
  const auto add = [&](const std::string& file, const std::string& by) {
    std::error_code none;
    if (!std::filesystem::is_regular_file(file, none)) return;
    for (Ledger& ledger : correlation::ledgers_of_file(file, by)) {
      const bool is_known = std::any_of(known.begin(), known.end(), [&](const Ledger& one) {
        return std::filesystem::equivalent(one.file, ledger.file, none);
      });
      if (!is_known) known.push_back(std::move(ledger));
    }
  };
  add(model, "the model");
  if (!test.starts_with('{')) add(test, "the test");
  for (const std::filesystem::path& file : test_files) add(file.string(), "the test");
  return known;
}

}  // namespace latsch::cli
