// SPDX-License-Identifier: Apache-2.0
#include "studio/http/target.h"

#include <charconv>

#include "base/error.h"
#include "base/text.h"
#include "base/utf8.h"

namespace latsch::studio {
namespace {

/// Decodes percent-encoded characters and, in a query, "+" as a blank.
std::string decoded(std::string_view text, bool is_query) {
  std::string result;
  for (std::size_t at = 0; at < text.size(); ++at) {
    if (text[at] == '%') {
      unsigned char code = 0;
      const char* first = text.data() + at + 1;
      if (at + 2 >= text.size() || std::from_chars(first, first + 2, code, 16).ptr != first + 2)
        throw InputError(in_quotes(text) + " has a % without two hexadecimal digits behind it");
      result += static_cast<char>(code);
      at += 2;
    } else {
      result += is_query && text[at] == '+' ? ' ' : text[at];
    }
  }
  if (!is_utf8(result)) throw InputError(in_quotes(text) + " is no UTF-8");
  if (result.find('\0') != result.npos) throw InputError(in_quotes(text) + " has a zero byte");
  return result;
}

void check_path(std::string_view path) {
  for (const char c : path)
    if (c == '\\' || static_cast<unsigned char>(c) < 0x20 || c == 0x7f)
      throw InputError("the path " + in_quotes(path) + " has a backslash or a control character");
  for (std::size_t begin = 1; begin <= path.size();) {
    const std::size_t end = std::min(path.find('/', begin), path.size());
    const std::string_view segment = path.substr(begin, end - begin);
    if (segment == "." || segment == "..")
      throw InputError("the path " + in_quotes(path) + " has a segment " + in_quotes(segment));
    begin = end + 1;
  }
}

}  // namespace

Target parse_target(std::string_view target) {
  if (!target.starts_with('/'))
    throw InputError("the target " + in_quotes(target) +
                     " is not a path, expected one such as \"/\"");
  const std::size_t mark = std::min(target.find('?'), target.size());
  Target result{decoded(target.substr(0, mark), false), {}};
  check_path(result.path);
  std::string_view rest = target.substr(std::min(mark + 1, target.size()));
  while (!rest.empty()) {
    const std::string_view item = rest.substr(0, rest.find('&'));
    rest.remove_prefix(std::min(item.size() + 1, rest.size()));
    if (item.empty()) continue;
    const std::size_t equals = std::min(item.find('='), item.size());
    const std::string name = decoded(item.substr(0, equals), true);
    const std::string value = decoded(item.substr(std::min(equals + 1, item.size())), true);
    if (!result.query.emplace(name, value).second)
      throw InputError("the query has " + in_quotes(name) + " twice");
  }
  return result;
}

}  // namespace latsch::studio
