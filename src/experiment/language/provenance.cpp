// SPDX-License-Identifier: Apache-2.0
#include "experiment/language/provenance.h"

#include <algorithm>

namespace latsch::experiment {
namespace {

constexpr std::size_t kWidth = 96;  // characters of a line, mark included
// blanks at the beginning of each further line of a sentence
constexpr const char* kFurther = "  ";

}  // namespace

std::string on_one_line(std::string text) {
  std::replace_if(
      text.begin(),
      text.end(),
      [](char c) { return static_cast<unsigned char>(c) < 0x20 || c == 0x7f; },
      ' ');
  return text;
}

std::string comment_lines(const std::vector<std::string>& lines, const std::string& mark) {
  std::string text;
  for (const std::string& given : lines) {
    std::string rest = on_one_line(given), indent;
    while (mark.size() + indent.size() + rest.size() > kWidth) {
      const std::size_t most = kWidth - mark.size() - indent.size();
      std::size_t end = rest.rfind(' ', most);
      if (end == std::string::npos || end == 0) end = rest.find(' ', 1);
      if (end == std::string::npos) break;
      text += mark + indent + rest.substr(0, end) + "\n";
      rest.erase(0, end + 1);
      indent = kFurther;
    }
    text += mark + indent + rest + "\n";
  }
  return text;
}

std::string SpecimenKind::annotated_text(const Document& numbers,
                                         const Provenance& provenance) const {
  std::vector<std::string> lines = provenance.header;
  for (const auto& [path, origin] : provenance.origins) lines.push_back(path + ": " + origin);
  lines.push_back("The other numbers are those of " + provenance.model_name + ".");
  return comment_lines(lines, comment_mark() + " ") + text(numbers);
}

}  // namespace latsch::experiment
