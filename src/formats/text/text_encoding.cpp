// SPDX-License-Identifier: Apache-2.0
#include "formats/text/text_encoding.h"

#include <algorithm>
#include <utility>

#include "base/error.h"
#include "base/utf8.h"
#include "formats/text/file_marks.h"

namespace latsch::formats {
namespace {

bool continues(char c) { return (static_cast<unsigned char>(c) & 0xc0) == 0x80; }

/// Characters of the bytes 0x80 to 0x9f in Windows-1252 [unicode.org, CP1252.TXT]; 0 if there is
/// none.
constexpr char16_t kWindows[32] = {0x20ac, 0,      0x201a, 0x0192, 0x201e, 0x2026, 0x2020, 0x2021,
                                   0x02c6, 0x2030, 0x0160, 0x2039, 0x0152, 0,      0x017d, 0,
                                   0,      0x2018, 0x2019, 0x201c, 0x201d, 0x2022, 0x2013, 0x2014,
                                   0x02dc, 0x2122, 0x0161, 0x203a, 0x0153, 0,      0x017e, 0x0178};

void append_utf8(char16_t code, std::string& text) {
  if (code < 0x80) {
    text += static_cast<char>(code);
  } else if (code < 0x800) {
    text += static_cast<char>(0xc0 | (code >> 6));
    text += static_cast<char>(0x80 | (code & 0x3f));
  } else {
    text += static_cast<char>(0xe0 | (code >> 12));
    text += static_cast<char>(0x80 | ((code >> 6) & 0x3f));
    text += static_cast<char>(0x80 | (code & 0x3f));
  }
}

std::string from_windows_1252(std::string_view bytes) {
  std::string text;
  text.reserve(bytes.size() + bytes.size() / 8);
  for (const char c : bytes) {
    const auto byte = static_cast<unsigned char>(c);
    const bool own = byte >= 0x80 && byte < 0xa0 && kWindows[byte - 0x80] != 0;
    append_utf8(own ? kWindows[byte - 0x80] : byte, text);
  }
  return text;
}

/// Throws InputError for UTF-16 and for zero bytes, which do not occur in a text with one byte per
/// character.
void expect_text(std::string_view bytes, const std::string& file) {
  refuse_utf16(bytes, file);
  const auto zero = bytes.find('\0');
  if (bytes.find('\n') == bytes.npos && bytes.find('\r') < bytes.size() - 1)
    throw InputError({file, 0},
                     "has lines that end in a carriage return alone, as old Macintosh programs "
                     "write them: save it with line feeds");
  if (zero == bytes.npos) return;
  const auto line = std::count(bytes.begin(), bytes.begin() + static_cast<long>(zero), '\n') + 1;
  throw InputError({file, static_cast<int>(line)},
                   "holds a zero byte, expected a text file in UTF-8");
}

bool is_ascii(std::string_view bytes) {
  return std::none_of(bytes.begin(), bytes.end(), [](char c) { return (c & 0x80) != 0; });
}

/// Counts the byte pairs that are one character in Shift-JIS (Windows code page 932) and begin as
/// kana and usual kanji do, with 0x81 to 0x9f, and the bytes above ASCII that belong to no pair. An
/// umlaut of Windows-1252 with the letter behind it is a pair that begins at 0xc4 or above.
std::pair<std::size_t, std::size_t> japanese_pairs(std::string_view bytes) {
  std::size_t pairs = 0, others = 0;
  for (std::size_t i = 0; i < bytes.size(); ++i) {
    const auto first = static_cast<unsigned char>(bytes[i]);
    if (first < 0x80) continue;
    const auto second = i + 1 < bytes.size() ? static_cast<unsigned char>(bytes[i + 1]) : 0;
    const bool leads = (first >= 0x81 && first <= 0x9f) || (first >= 0xe0 && first <= 0xfc);
    const bool follows = second >= 0x40 && second != 0x7f && second <= 0xfc;
    const bool is_kana = first >= 0xa1 && first <= 0xdf;  // half-width, one byte each
    if (leads && follows) {
      pairs += first <= 0x9f;
      ++i;
    } else if (!is_kana) {
      ++others;
    }
  }
  return {pairs, others};
}

}  // namespace

std::string utf8_text(std::string bytes, const std::string& file) {
  expect_text(bytes, file);
  if (bytes.starts_with("\xef\xbb\xbf")) bytes.erase(0, 3);
  return is_utf8(bytes) ? bytes : from_windows_1252(bytes);
}

std::shared_ptr<const MappedFile> utf8_file(std::shared_ptr<const MappedFile> source,
                                            const std::string& file) {
  const std::string_view bytes = source->text();
  expect_content_of_ending(file, bytes);
  expect_text(bytes, file);
  const bool is_kept = is_ascii(bytes) || is_utf8(bytes);
  source->let_go(bytes.size());
  if (is_kept) return source;
  return std::make_shared<const MappedFile>(from_windows_1252(bytes));
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

std::string assumed_encoding(std::string_view bytes) {
  constexpr std::size_t kLookedAt = std::size_t{1} << 16;  // bytes
  if (bytes.size() > kLookedAt) {
    bytes = bytes.substr(0, kLookedAt);
    bytes = bytes.substr(0, bytes.rfind('\n'));
  }
  if (is_utf8(bytes)) return "";
  const auto [pairs, others] = japanese_pairs(bytes);
  constexpr std::size_t kFewestPairs = 2;
  if (pairs >= kFewestPairs && others == 0)
    return "Windows-1252, because the bytes are no UTF-8; they look like Shift-JIS, in which the "
           "names are others: save the file as UTF-8";
  return "Windows-1252, because the bytes are no UTF-8";
}

}  // namespace latsch::formats
