// SPDX-License-Identifier: Apache-2.0
// Checks whether bytes are UTF-8 [RFC 3629]: shortest forms only, no surrogates, nothing above
// U+10FFFF.
#pragma once

#include <string>
#include <string_view>

namespace latsch {

bool is_utf8(std::string_view bytes);

/// Returns the text with every byte that belongs to no character replaced by U+FFFD.
std::string replaced_where_no_utf8(std::string_view bytes);

}  // namespace latsch
