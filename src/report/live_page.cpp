// SPDX-License-Identifier: Apache-2.0
#include "report/live_page.h"

#include <fmt/format.h>

#include "report/html_text.h"
#include "report/page_style.h"

namespace latsch::report {
namespace {

/// Returns JSON that can stand in an HTML script element. There "</" would end the script and "<!"
/// would change how it is parsed; "<" occurs only in JSON texts, where it can be escaped.
std::string json_within_script(std::string_view json) {
  std::string safe;
  safe.reserve(json.size());
  for (const char c : json) {
    if (c == '<') {
      safe += "\\u003c";
    } else {
      safe += c;
    }
  }
  return safe;
}

}  // namespace

std::string live_page_begin(std::string_view title, const LivePage& live) {
  return fmt::format(
      "<!DOCTYPE html>\n<html lang=\"en\">\n<head>\n<meta charset=\"utf-8\">\n"
      "<meta name=\"viewport\" content=\"width=device-width, initial-scale=1\">\n"
      "<title>{}</title>\n<style id=\"printed-style\">{}</style>\n"
      "<style id=\"studio-style\" media=\"not all\">{}</style>\n</head>\n<body>\n"
      "<div id=\"studio\" hidden></div>\n<main id=\"printed\">\n",
      escape(title),
      style_sheet(),
      live.style);
}

std::string live_page_end(const LivePage& live) {
  return fmt::format(
      "</main>\n<script type=\"application/json\" id=\"answers\">{}</script>\n"
      "<script>{}</script>\n</body>\n</html>\n",
      json_within_script(live.answers),
      live.script);
}

}  // namespace latsch::report
