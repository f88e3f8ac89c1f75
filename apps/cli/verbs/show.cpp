// SPDX-License-Identifier: Apache-2.0
// Implements `latsch show`: shows the content of a file, with units, on the terminal or as a page.

#include <algorithm>
#include <cmath>
#include <filesystem>
#include <nlohmann/json.hpp>
#include <optional>
#include <utility>

#include "base/file.h"
#include "cli/console/console.h"
#include "cli/verbs/shown_page.h"
#include "cli/verbs/verbs.h"
#include "correlation/laboratory/measurement.h"
#include "correlation/study/ledgers/file_ledgers.h"
#include "correlation/study/ledgers/study_ledgers.h"
#include "correlation/study/study.h"
#include "formats/tables/lab_table.h"

namespace latsch::cli {
namespace {

constexpr std::size_t kWidest = 40;    // characters; widest column on the terminal
constexpr std::size_t kLongest = 400;  // characters; longest sentence

std::size_t characters(const std::string& text) {
  return std::count_if(text.begin(), text.end(), [](char c) { return (c & 0xc0) != 0x80; });
}

/// Returns the text cut to `widest` characters and without control characters.
std::string plain(const std::string& text, std::size_t widest = kWidest) {
  std::string result;
  std::size_t count = 0;
  for (const char c : text) {
    if ((c & 0xc0) != 0x80 && ++count > widest) return result + "...";
    result += static_cast<unsigned char>(c) < 0x20 || c == 0x7f ? '?' : c;
  }
  return result;
}

void print_table(const ShownTable& table) {
  say("\n{}\n", table.title);
  std::vector<std::size_t> widths;
  for (const std::string& head : table.heads) widths.push_back(characters(head));
  for (const auto& row : table.rows)
    for (std::size_t i = 0; i < row.size(); ++i)
      widths[i] = std::max(widths[i], characters(plain(row[i])));
  const auto print_row = [&](const std::vector<std::string>& row) {
    std::string line;
    for (std::size_t i = 0; i < row.size(); ++i) {
      const std::string cell = plain(row[i]);
      line += "  " + cell + std::string(widths[i] - std::min(widths[i], characters(cell)), ' ');
    }
    line.erase(line.find_last_not_of(' ') + 1);
    say("{}\n", line);
  };
  print_row(table.heads);
  for (const auto& row : table.rows) print_row(row);
}

bool is_recording(const std::string& file) {
  std::string ending = std::filesystem::path(file).extension().string();
  for (char& c : ending)
    if (c >= 'A' && c <= 'Z') c = static_cast<char>(c - 'A' + 'a');
  const std::vector<std::string> endings = formats::lab_endings();
  return std::find(endings.begin(), endings.end(), ending) != endings.end();
}

/// Adds to the ledgers which parts of a study use each column. This needs the whole study; if
/// reading it fails, the users stay unknown.
void name_users(const std::string& file, const experiment::Language& language, ShownFile& shown) {
  if (shown.ledgers.empty()) return;
  std::vector<Ledger> known;
  try {
    known = correlation::ledgers_of(correlation::read_study(file, language));
  } catch (const InputError&) {
    return;  // then only the users within the measurement itself are known
  }
  std::erase_if(shown.tables,
                [](const ShownTable& table) { return table.heads == ledger_heads(); });
  std::erase_if(shown.facts, [&](const std::string& fact) {
    return fact.starts_with("? ") ||
           std::any_of(shown.ledgers.begin(), shown.ledgers.end(), [&](const Ledger& ledger) {
             return fact.ends_with(": " + in_one_line(ledger));
           });
  });
  const auto before = std::exchange(shown.ledgers, {});
  for (const Ledger& ledger : known)
    if (std::any_of(before.begin(), before.end(), [&](const Ledger& one) {
          return one.file == ledger.file;
        }))
      show_ledger(ledger, true, shown, known);
}

/// True if no column of a recording could be read as numbers, because of texts, unknown units, or a
/// lack of rows.
bool has_no_channel(const std::string& file, const ShownFile& shown) {
  const bool may_be =
      std::any_of(shown.facts.begin(), shown.facts.end(), [](const std::string& fact) {
        return fact.starts_with("no channels: ");
      });
  if (!may_be) return false;
  try {
    const Channels channels = correlation::read_measured_file(file).channels;
    return std::none_of(channels.all().begin(), channels.all().end(), [](const Channel& channel) {
      return std::any_of(channel.values.begin(), channel.values.end(), [](double value) {
        return std::isfinite(value);
      });
    });
  } catch (const InputError&) {
    return true;
  }
}

int show(const std::string& file,
         const std::string& html,
         const std::string& axes,
         const std::string& measurement,
         const experiment::Language& language) {
  expect_file(file);
  if (!axes.empty() && !is_recording(file))
    throw InputError({file, 0},
                     "is no recording, so --axes has no effect; expected the command without it");
  ShownFile shown = measurement.empty()
                        ? shown_file(file, axis_convention_of(axes.empty() ? "iso" : axes))
                        : shown_measurements(file, measurement);
  if (is_recording(file))
    show_ledger_of(
        file, axes.empty() ? std::nullopt : std::optional(axis_convention_of(axes)), shown);
  else
    name_users(file, language, shown);
  if (shown.ledgers.empty() && !is_recording(file))
    for (const auto ledgers = correlation::ledgers_of_file(file, "the model");
         const Ledger& ledger : ledgers)
      show_ledger(ledger, true, shown, ledgers);
  // The page is written before the text, because `latsch show FILE --html PAGE | head` ends the
  // program at the tenth line.
  if (!html.empty()) write_text_file(html, shown_page(file, shown));
  answer()["kind"] = shown.kind;
  answer()["facts"] = shown.facts;
  for (const Ledger& ledger : shown.ledgers)
    answer()["ledgers"].push_back(correlation::json_of(ledger));
  for (const ShownTable& table : shown.tables)
    answer()["tables"].push_back(
        {{"title", table.title}, {"heads", table.heads}, {"rows", table.rows}});
  say("{}\n{}\n", file, shown.kind);
  for (const std::string& fact : shown.facts) say("  {}\n", plain(fact, kLongest));
  for (const ShownTable& table : shown.tables) print_table(table);
  if (!html.empty()) {
    say("\n");
    say_written(html);
  }
  return is_recording(file) && has_no_channel(file, shown) ? kWrongInput : kDone;
}

}  // namespace

void add_show(CommandLine& app, Program& program) {
  Verb verb = app.add_subcommand("show", "Shows what was read from a file: units, axes, channels");
  verb.footer(
      "Reads TYDEX (.tdx), tables (.csv, .dat), MATLAB (.mat), files of recorders: MDF 4 (.mf4),\n"
      "universal files (.uff), TDMS (.tdms), RPC III (.rsp, .drv, .tim), MoTeC (.ld, "
      "experimental);\n"
      "tires (.tir), roads (.crg, .rdf, .toml), decks (.inp); of a study its measurements, of any\n"
      "other .toml its numbers in SI.\n\n"
      "Examples:\n  latsch show studies/race_tire_mf/cornering.csv --html cornering.html\n"
      "  latsch show studies/race_tire_mf/tire.tir\n"
      "  latsch show studies/race_tire_mf/study.toml --measurement cornering --html "
      "cornering.html");
  auto file = std::make_shared<std::string>();
  auto html = std::make_shared<std::string>();
  verb.add_option("file", *file, "File to look at").required();
  verb.add_option("--html", *html, "Page with plots and tables to write")
      .written_as("HTML", {".html", ".htm"});
  auto axes = std::make_shared<std::string>();
  verb.add_option("--axes",
                  *axes,
                  "Signs of the file: iso unless given, adapted_sae, sae or adams; shown in iso");
  auto measurement = std::make_shared<std::string>();
  verb.add_option("--measurement", *measurement, "Of a study: the one [measurement.NAME] to show");
  verb.callback([=, &program] {
    program.exit_code = show(*file, *html, *axes, *measurement, program.language);
  });
}

}  // namespace latsch::cli
