// SPDX-License-Identifier: Apache-2.0
// Tire files edited line by line, so that comments and order stay.
#pragma once

#include <algorithm>
#include <string>
#include <string_view>

namespace latsch::cli {

/// `text` with each line, its end included, as `replaced` gives it.
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
