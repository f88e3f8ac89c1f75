// SPDX-License-Identifier: Apache-2.0
// Converts words of file formats to upper or lower case: only the letters a to z change,
// independent of the locale.
#pragma once

#include <string>
#include <string_view>

namespace latsch::formats {

std::string lower(std::string_view text);
std::string capitals(std::string_view text);

}  // namespace latsch::formats
