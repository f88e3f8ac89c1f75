// SPDX-License-Identifier: Apache-2.0
// Encodes bytes as Base64 text [RFC 4648, section 4].
#pragma once

#include <string>
#include <string_view>

namespace latsch::studio {

std::string base64(std::string_view bytes);

}  // namespace latsch::studio
