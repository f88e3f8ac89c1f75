// SPDX-License-Identifier: Apache-2.0
// Checks whether bytes are UTF-8 [RFC 3629]: shortest forms only, no surrogates, nothing above
// U+10FFFF. Recognizes UTF-16, which no reader takes.
#pragma once

#include <filesystem>
#include <string>
#include <string_view>

namespace latsch {

bool is_utf8(std::string_view bytes);

/// Returns the path that a text in UTF-8 names. On Windows a path made of plain characters would be
/// read in another encoding.
std::filesystem::path path_of_utf8(std::string_view text);

/// Throws InputError if the bytes of this file are UTF-16: if they begin with its byte order mark,
/// or if every other one of the first four bytes is zero, as in its ASCII letters.
void refuse_utf16(std::string_view bytes, const std::string& file);

/// Returns the text with every byte that belongs to no character replaced by U+FFFD.
std::string replaced_where_no_utf8(std::string_view bytes);

}  // namespace latsch
