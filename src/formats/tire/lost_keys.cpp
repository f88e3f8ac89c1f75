// SPDX-License-Identifier: Apache-2.0
#include "formats/tire/lost_keys.h"

#include <algorithm>
#include <cctype>
#include <set>
#include <sstream>
#include <vector>

#include "base/file.h"
#include "base/text.h"
#include "formats/text/letter_case.h"
#include "models/magic_formula/parameters.h"

namespace latsch::formats {
namespace {

std::string upper(std::string_view word) {
  std::string text(word);
  for (char& c : text) c = static_cast<char>(std::toupper(static_cast<unsigned char>(c)));
  return text;
}

/// Keys and sections of a .tir file, in upper case: "PDY1", "[SHAPE]".
struct TirWords {
  std::vector<std::string> keys, sections;
};

TirWords words_of(const std::string& text) {
  TirWords words;
  std::istringstream lines(text);
  std::string section;
  for (std::string line; std::getline(lines, line);) {
    const std::string_view rest = trimmed(line);
    if (rest.empty() || rest.front() == '$' || rest.front() == '!') continue;
    if (rest.front() == '[') {
      section = upper(rest.substr(0, rest.find(']') + 1));
      words.sections.push_back(section);
      continue;
    }
    const auto equals = rest.find('=');
    // Units and the header are those of the exporting program.
    if (equals == std::string_view::npos || section == "[UNITS]" || section == "[MDI_HEADER]")
      continue;
    words.keys.push_back(upper(trimmed(rest.substr(0, equals))));
  }
  return words;
}

std::vector<std::string> without(const std::vector<std::string>& words,
                                 const std::vector<std::string>& others) {
  const std::set<std::string> there(others.begin(), others.end());
  std::vector<std::string> left;
  for (const std::string& word : words)
    if (!there.contains(word)) left.push_back(word);
  return left;
}

}  // namespace

std::vector<std::string> lost_keys(const std::filesystem::path& file, const std::string& exported) {
  if (lower(file.extension().string()) != ".tir") return {};
  const TirWords before = words_of(read_text_file(file)), after = words_of(exported);
  std::vector<std::string> lost = without(before.keys, after.keys);
  // A coefficient at its default is not written, but read as the same value.
  std::erase_if(lost, [](const std::string& key) { return magic_formula::find_parameter(key); });
  for (const std::string& section : without(before.sections, after.sections))
    if (section == "[SHAPE]" || section.ends_with("_CURVE]") || section.ends_with("_TABLE]"))
      lost.push_back("the table " + section);
  return lost;
}

}  // namespace latsch::formats
