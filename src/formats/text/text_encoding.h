// SPDX-License-Identifier: Apache-2.0
// Converts text files of laboratories to UTF-8. Files of Windows programs are in Windows-1252,
// which is Latin-1 with printed characters instead of 32 control characters.
#pragma once

#include <memory>
#include <string>
#include <string_view>

#include "base/mapped_file.h"

namespace latsch::formats {

/// Returns the text without a byte order mark. Bytes that are no UTF-8 make the whole text
/// Windows-1252. Throws InputError for UTF-16 and for a zero byte, naming the line.
std::string utf8_text(std::string bytes, const std::string& file);

/// Returns `source` itself if it is UTF-8, with its byte order mark if it has one; else a converted
/// copy in memory.
std::shared_ptr<const MappedFile> utf8_file(std::shared_ptr<const MappedFile> source,
                                            const std::string& file);

/// Returns in words the encoding that `utf8_file` assumes for a text that is not UTF-8, and whether
/// the bytes look like Shift-JIS instead; empty for UTF-8. Only the beginning of a long text is
/// examined, because the names of columns are there.
std::string assumed_encoding(std::string_view bytes);

/// Returns the characters `first` to `first + count - 1`, counted from 0, of a line of UTF-8, as
/// far as they exist.
std::string_view columns_of(std::string_view line, std::size_t first, std::size_t count);

}  // namespace latsch::formats
