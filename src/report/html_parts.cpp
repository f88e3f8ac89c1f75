// SPDX-License-Identifier: Apache-2.0
#include "report/html_parts.h"

#include <fmt/format.h>

#include "report/html_text.h"
#include "report/line_plot.h"

namespace latsch::report {
namespace {

std::string table_row(const std::vector<std::string>& cells, const char* tag) {
  std::string html = "<tr>";
  for (std::size_t i = 0; i < cells.size(); ++i)
    html += fmt::format("<{0}{1}>{2}</{0}>", tag, i == 0 ? "" : " class=\"n\"", escape(cells[i]));
  return html + "</tr>\n";
}

}  // namespace

std::string figure(std::string_view heading,
                   std::string_view quiet,
                   std::string_view picture,
                   std::string_view caption) {
  std::string html = "<figure>";
  if (!heading.empty()) {
    html += fmt::format("<b>{}{}</b>",
                        escape(heading),
                        quiet.empty() ? "" : fmt::format(" <span>{}</span>", escape(quiet)));
  }
  html += picture;
  if (!caption.empty()) html += fmt::format("<figcaption>{}</figcaption>", escape(caption));
  return html + "</figure>\n";
}

std::string figure(std::string_view heading, const LinePlot& plot, std::string_view caption) {
  return figure(heading, "", line_plot(plot), caption);
}

std::string number_table(const std::vector<std::string>& heads,
                         const std::vector<std::vector<std::string>>& rows) {
  std::string html =
      "<div class=\"scroll\"><table><thead>" + table_row(heads, "th") + "</thead><tbody>\n";
  for (const auto& cells : rows) html += table_row(cells, "td");
  return html + "</tbody></table></div>\n";
}

}  // namespace latsch::report
