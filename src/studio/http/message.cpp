// SPDX-License-Identifier: Apache-2.0
#include "studio/http/message.h"

#include <fmt/format.h>

#include "base/utf8.h"

namespace latsch::studio {

std::string json_string(std::string_view text) {
  std::string json = "\"";
  for (const char c : replaced_where_no_utf8(text)) {
    if (static_cast<unsigned char>(c) < 0x20) {
      json += fmt::format("\\u{:04x}", static_cast<unsigned char>(c));
      continue;
    }
    if (c == '"' || c == '\\') json += '\\';
    json += c;
  }
  return json + '"';
}

Response error_response(int status, std::string_view error, std::string_view hint) {
  return {status,
          "application/json",
          fmt::format(R"({{"error": {}, "hint": {}}})", json_string(error), json_string(hint))};
}

}  // namespace latsch::studio
