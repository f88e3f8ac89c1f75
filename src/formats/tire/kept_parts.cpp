// SPDX-License-Identifier: Apache-2.0
#include "formats/tire/kept_parts.h"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <filesystem>
#include <set>
#include <utility>
#include <vector>

#include "base/text.h"
#include "formats/tire/tir_reader.h"

namespace latsch::formats {
namespace {

bool is_in_si(const TeimOrbitUnits& units) {
  return units.length() == 1.0 && units.force() == 1.0 && units.angle() == 1.0 &&
         units.mass() == 1.0 && units.time() == 1.0 && units.pressure() == 1.0;
}

std::string units_in_words(const TeimOrbit& source) {
  std::vector<std::string> words;
  if (const TeimOrbitSection* units = source.find("UNITS"))
    for (const TeimOrbitEntry& entry : units->entries())
      words.push_back(entry.key + " = " + entry.value);
  return fmt::format("{}", fmt::join(words, ", "));
}

/// Returns the line numbers of the keys that set no parameter.
std::set<int> lines_of_unused_keys(const TirFile& tir) {
  std::set<int> lines;
  for (const TirKey& key : tir.keys)
    if (key.parameter.empty() && !key.key.starts_with('{')) lines.insert(key.line);
  return lines;
}

std::string line_of_entry(const TeimOrbitEntry& entry) {
  const std::string comment =
      entry.comment.empty() ? "" : "  $ " + std::string(trimmed(entry.comment));
  return fmt::format(
      "{:<24} = {}{}", entry.key, entry.quoted ? "'" + entry.value + "'" : entry.value, comment);
}

void add_table(const TeimOrbitTable& table, std::vector<std::string>& lines) {
  if (!table.block.empty()) lines.push_back("(" + table.block + ")");
  if (!table.heads.empty()) lines.push_back(fmt::format("{{{}}}", fmt::join(table.heads, " ")));
  for (const TeimOrbitRow& row : table.rows)
    lines.push_back(fmt::format("{}", fmt::join(row.fields, " ")));
}

std::vector<std::string> kept_lines(const TirFile& tir,
                                    const TeimOrbitSection& section,
                                    const std::set<int>& unused,
                                    bool in_si) {
  std::vector<std::string> lines;
  if (holds_no_parameters(section)) return lines;
  for (const TeimOrbitEntry& entry : section.entries())
    if (unused.contains(entry.line)) lines.push_back(line_of_entry(entry));
  if (section.name() != "DEFLECTION_LOAD_CURVE")
    for (const TeimOrbitTable& table : section.tables()) add_table(table, lines);
  if (lines.empty() || in_si || section.name() == "SHAPE") return lines;
  for (std::string& line : lines) line = "$ " + line;
  lines.insert(lines.begin(),
               fmt::format("$ kept from {}, in its units: {}",
                           std::filesystem::path(tir.source.file()).filename().string(),
                           units_in_words(tir.source)));
  return lines;
}

}  // namespace

std::string with_kept_parts(const std::string& text, const TirFile& tir) {
  const bool in_si = is_in_si(tir.source.units(TeimOrbitUnits::Missing::is_si));
  const std::set<int> unused = lines_of_unused_keys(tir);
  std::string kept = text;
  for (const TeimOrbitSection& section : tir.source.sections()) {
    const std::vector<std::string> lines = kept_lines(tir, section, unused, in_si);
    if (lines.empty()) continue;
    const std::string part = fmt::format("{}\n", fmt::join(lines, "\n"));
    const std::string head = "[" + section.name() + "]\n";
    const bool is_first = kept.starts_with(head);
    const std::size_t begin = is_first ? 0 : kept.find("\n" + head);
    if (begin == kept.npos) {
      kept += head + part;
      continue;
    }
    const std::size_t end = kept.find("\n[", begin + head.size());
    kept.insert(end == kept.npos ? kept.size() : end + 1, part);
  }
  return kept;
}

}  // namespace latsch::formats
