// SPDX-License-Identifier: Apache-2.0
// Text files of laboratories as UTF-8: German comments of the nineties are Latin-1.
#pragma once

#include <string>
#include <string_view>

namespace latsch::formats {

/// Without a byte order mark. Bytes that are no UTF-8 make the whole text Latin-1. Throws
/// InputError for UTF-16 and for a zero byte, naming the line.
std::string utf8_text(std::string bytes, const std::string& file);

/// Characters `first` ... `first + count - 1` of a line of UTF-8, counted from 0; what is there of
/// them.
std::string_view columns_of(std::string_view line, std::size_t first, std::size_t count);

}  // namespace latsch::formats
