// SPDX-License-Identifier: Apache-2.0
#include "formats/text/text_encoding.h"

#include <algorithm>

#include "base/error.h"
#include "base/utf8.h"

namespace latsch::formats {
namespace {

bool continues(char c) { return (static_cast<unsigned char>(c) & 0xc0) == 0x80; }

std::string from_latin_1(std::string_view bytes) {
  std::string text;
  text.reserve(bytes.size() + bytes.size() / 8);
  for (const char c : bytes) {
    const auto code = static_cast<unsigned char>(c);
    if (code < 0x80) {
      text += c;
    } else {
      text += static_cast<char>(0xc0 | (code >> 6));
      text += static_cast<char>(0x80 | (code & 0x3f));
    }
  }
  return text;
}

}  // namespace

std::string utf8_text(std::string bytes, const std::string& file) {
  if (bytes.starts_with("\xff\xfe") || bytes.starts_with("\xfe\xff")) {
    throw InputError({file, 0}, "is UTF-16 text, expected UTF-8 or Latin-1");
  }
  if (bytes.starts_with("\xef\xbb\xbf")) bytes.erase(0, 3);
  if (const auto zero = bytes.find('\0'); zero != bytes.npos) {
    const auto line = std::count(bytes.begin(), bytes.begin() + zero, '\n') + 1;
    throw InputError({file, static_cast<int>(line)}, "has a zero byte, expected text");
  }
  return is_utf8(bytes) ? bytes : from_latin_1(bytes);
}

std::string_view columns_of(std::string_view line, std::size_t first, std::size_t count) {
  const auto skip = [&](std::size_t at, std::size_t characters) {
    for (; characters > 0 && at < line.size(); --characters) {
      ++at;
      while (at < line.size() && continues(line[at])) ++at;
    }
    return at;
  };
  const std::size_t begin = skip(0, first);
  return line.substr(begin, skip(begin, count) - begin);
}

}  // namespace latsch::formats
