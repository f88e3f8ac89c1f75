// SPDX-License-Identifier: Apache-2.0
#include "base/utf8.h"

#include <cstddef>

#include "base/error.h"

namespace latsch {
namespace {

/// A character that begins with the byte `first` has `length` bytes, and its second byte lies
/// between the two bounds [RFC 3629, 4]. The length is 0 if no character begins with `first`.
struct Utf8Form {
  std::size_t length = 0;
  unsigned char least = 0x80;
  unsigned char most = 0xbf;
};

Utf8Form utf8_form(unsigned char first) {
  if (first < 0x80) return {1};
  if (first < 0xc2) return {};
  if (first < 0xe0) return {2};
  // A smaller second byte would encode a character with more bytes than necessary.
  if (first == 0xe0) return {3, 0xa0};
  if (first == 0xed) return {3, 0x80, 0x9f};  // higher second bytes would be surrogates
  if (first < 0xf0) return {3};
  if (first == 0xf0) return {4, 0x90};
  if (first < 0xf4) return {4};
  if (first == 0xf4) return {4, 0x80, 0x8f};  // higher second bytes would be beyond U+10FFFF
  return {};
}

/// Returns the number of bytes of the character at the beginning; 0 if there is none.
std::size_t utf8_character(std::string_view bytes) {
  const auto code = [&](std::size_t i) { return static_cast<unsigned char>(bytes[i]); };
  const Utf8Form form = utf8_form(code(0));
  if (form.length == 0 || form.length > bytes.size()) return 0;
  if (form.length > 1 && (code(1) < form.least || code(1) > form.most)) return 0;
  for (std::size_t i = 2; i < form.length; ++i)
    if (code(i) < 0x80 || code(i) > 0xbf) return 0;
  return form.length;
}

}  // namespace

void refuse_utf16(std::string_view bytes, const std::string& file) {
  const auto zero = bytes.find('\0');
  const bool alternates =
      zero <= 1 && bytes.size() > 3 && bytes[zero + 1] != '\0' && bytes[zero + 2] == '\0';
  if (bytes.starts_with("\xff\xfe") || bytes.starts_with("\xfe\xff") || alternates)
    throw InputError({file, 0}, "is UTF-16 text, expected UTF-8: save it as UTF-8");
}

bool is_utf8(std::string_view bytes) {
  while (!bytes.empty()) {
    const std::size_t length = utf8_character(bytes);
    if (length == 0) return false;
    bytes.remove_prefix(length);
  }
  return true;
}

std::string replaced_where_no_utf8(std::string_view bytes) {
  std::string text;
  while (!bytes.empty()) {
    const std::size_t length = utf8_character(bytes);
    text += length > 0 ? bytes.substr(0, length) : "\xef\xbf\xbd";
    bytes.remove_prefix(length > 0 ? length : 1);
  }
  return text;
}

std::filesystem::path path_of_utf8(std::string_view text) {
  return std::filesystem::path(std::u8string(text.begin(), text.end()));
}

}  // namespace latsch
