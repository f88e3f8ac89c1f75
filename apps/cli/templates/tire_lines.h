// SPDX-License-Identifier: Apache-2.0
// Functions that edit the text of a tire file line by line, so that comments and the order of lines
// remain.
#pragma once

#include <algorithm>
#include <string>
#include <string_view>

namespace latsch::cli {

/// Returns `text` with each line, including its end, replaced by the result of `replaced`.
template <class Replaced>
std::string by_lines(std::string_view text, Replaced replaced) {
  std::string result;
  while (!text.empty()) {
    const auto end = std::min(text.find('\n'), text.size() - 1) + 1;
    result += replaced(std::string(text.substr(0, end)));
    text.remove_prefix(end);
  }
  return result;
}

}  // namespace latsch::cli
