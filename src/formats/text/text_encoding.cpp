// SPDX-License-Identifier: Apache-2.0
#include "formats/text/text_encoding.h"

#include <algorithm>

#include "base/error.h"

namespace latsch::formats {
namespace {

bool continues(char c) { return (static_cast<unsigned char>(c) & 0xc0) == 0x80; }

/// Bytes of the character that begins so; 0 where none does.
std::size_t length_of(unsigned char first) {
  if (first < 0x80) return 1;
  if (first >= 0xc2 && first < 0xe0) return 2;
  if (first >= 0xe0 && first < 0xf0) return 3;
  if (first >= 0xf0 && first < 0xf5) return 4;
  return 0;
}

bool is_utf8(std::string_view text) {
  for (std::size_t at = 0; at < text.size();) {
    const std::size_t length = length_of(static_cast<unsigned char>(text[at]));
    if (length == 0 || at + length > text.size()) return false;
    for (std::size_t i = 1; i < length; ++i)
      if (!continues(text[at + i])) return false;
    at += length;
  }
  return true;
}

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
