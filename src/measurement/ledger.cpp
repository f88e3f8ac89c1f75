// SPDX-License-Identifier: Apache-2.0
#include "measurement/ledger.h"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <cmath>
#include <utility>

#include "base/text.h"

namespace latsch {
namespace {

constexpr int kDigits = 6;

/// Returns the number of rows in a state with their names: "2 not used (`NFX`, `TSTC`)".
std::string counted(const Ledger& ledger, LedgerState state, const char* words) {
  constexpr std::size_t kMostNames = 8;
  std::vector<std::string> names;
  for (const LedgerRow& row : ledger.rows)
    if (row.state == state) names.push_back("`" + row.written + "`");
  if (names.empty()) return "";
  const std::size_t count = names.size();
  if (count > kMostNames) {
    names.resize(kMostNames);
    names.emplace_back("...");
  }
  return fmt::format(", {} {} ({})", count, words, fmt::join(names, ", "));
}

/// Returns the word for a row of the file's ledger: "key" for a file of keys, "column" for a table.
std::string word_for_rows(const std::string& file) {
  for (const char* ending : {".toml", ".tir", ".TIR"})
    if (file.ends_with(ending)) return "key";
  for (const char* ending : {".rdf", ".crg", ".bus", ".inp"})
    if (file.ends_with(ending)) return "statement";
  return "column";
}

/// True if the only row of the ledger is the whole file, as for a script or an input file of a
/// program.
bool is_taken_whole(const Ledger& ledger) {
  const std::string name = ledger.file.substr(ledger.file.find_last_of('/') + 1);
  return ledger.rows.size() == 1 && !name.empty() && ledger.rows.front().written == name &&
         ledger.rows.front().state == LedgerState::used;
}

std::string factor_in_words(const LedgerRow& row) {
  std::string text = row.unit;
  if (row.factor != 1.0 || row.offset != 0.0)
    text += fmt::format(", {}", format_number(row.factor, kDigits));
  if (row.offset != 0.0)
    text += fmt::format(
        ", {} {}", row.offset < 0.0 ? "-" : "+", format_number(std::abs(row.offset), kDigits));
  return text;
}

}  // namespace

const char* name_of(LedgerState state) {
  switch (state) {
    case LedgerState::used:
      return "used";
    case LedgerState::not_used:
      return "not used";
    case LedgerState::assumed:
      return "assumed";
    case LedgerState::doubtful:
      break;
  }
  return "?";
}

const LedgerRow* Ledger::find_written(const std::string& name) const {
  const auto found = std::find_if(rows.begin(), rows.end(), [&](const LedgerRow& row) {
    return !row.written.empty() && row.written == name;
  });
  return found == rows.end() ? nullptr : &*found;
}

LedgerRow* Ledger::find_written(const std::string& name) {
  return const_cast<LedgerRow*>(std::as_const(*this).find_written(name));
}

const LedgerRow* Ledger::find_taken(const std::string& name) const {
  const auto found = std::find_if(rows.begin(), rows.end(), [&](const LedgerRow& row) {
    return !row.taken_as.empty() && row.taken_as == name;
  });
  return found == rows.end() ? nullptr : &*found;
}

LedgerRow* Ledger::find_taken(const std::string& name) {
  return const_cast<LedgerRow*>(std::as_const(*this).find_taken(name));
}

void Ledger::use(LedgerRow& row, const std::string& by) {
  if (std::find(row.used_by.begin(), row.used_by.end(), by) == row.used_by.end())
    row.used_by.push_back(by);
  if (row.state == LedgerState::not_used) row.state = LedgerState::used;
}

std::string in_one_line(const Ledger& ledger, const std::string& what) {
  if (is_taken_whole(ledger)) return "taken whole, as " + ledger.rows.front().taken_as;
  const auto count = [&](LedgerState state) {
    return std::count_if(ledger.rows.begin(), ledger.rows.end(), [&](const LedgerRow& row) {
      return row.state == state;
    });
  };
  const auto written = std::ssize(ledger.rows) - count(LedgerState::assumed);
  const std::string word = what == "column" ? word_for_rows(ledger.file) : what;
  std::string text = fmt::format(
      "{} {}{}: {} used", written, word, written == 1 ? "" : "s", count(LedgerState::used));
  text += counted(ledger, LedgerState::not_used, "not used");
  text += counted(ledger, LedgerState::doubtful, "in doubt");
  if (const auto assumed = count(LedgerState::assumed); assumed > 0) {
    std::vector<std::string> words;
    for (const LedgerRow& row : ledger.rows)
      if (row.state == LedgerState::assumed) words.push_back(row.taken_as + " " + row.remark);
    text += fmt::format(", {} assumed: {}", assumed, fmt::join(words, "; "));
  }
  return text;
}

std::vector<std::string> ledger_heads() {
  return {"written", "line", "taken as", "unit written", "meaning, factor", "axes", "used by"};
}

std::vector<std::string> ledger_cells(const LedgerRow& row) {
  std::string use = fmt::format("{}", fmt::join(row.used_by, ", "));
  if (row.state != LedgerState::used) {
    use = name_of(row.state) + (use.empty() ? "" : " (" + use + ")");
    if (!row.remark.empty()) use += ": " + row.remark;
  }
  std::string taken = row.taken_as.empty() ? "unknown" : row.taken_as;
  if (!row.meaning.empty() && row.meaning != row.taken_as) taken += ", " + row.meaning;
  std::string place = row.line > 0 ? std::to_string(row.line) : "";
  if (row.column > 0) place += ":" + std::to_string(row.column);
  return {row.written.empty() ? "(none)" : row.written,
          place,
          taken,
          row.unit_written.empty() ? "none" : row.unit_written,
          factor_in_words(row),
          row.axes,
          use};
}

}  // namespace latsch
