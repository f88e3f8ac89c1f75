// SPDX-License-Identifier: Apache-2.0
#include "cli/verbs/shown_page.h"

#include <fmt/format.h>

#include "report/html_parts.h"
#include "report/html_text.h"
#include "report/page_style.h"

namespace latsch::cli {
namespace {

using report::escape;

constexpr double kColumn = 600.0;  // px; a wider plot takes the whole width of the page

std::string table_html(const ShownTable& table) {
  std::string text = "<section>\n<h2>" + escape(table.title) + "</h2>\n<table>\n<tr>";
  for (const std::string& head : table.heads) text += "<th>" + escape(head) + "</th>";
  text += "</tr>\n";
  for (const auto& row : table.rows) {
    text += "<tr>";
    for (const std::string& cell : row) text += "<td>" + escape(cell) + "</td>";
    text += "</tr>\n";
  }
  return text + "</table>\n</section>\n";
}

std::string pictures_html(const ShownFile& shown) {
  std::string text;
  for (const experiment::Test::Picture& picture : shown.pictures)
    text += report::figure(picture.title, "", picture.svg, picture.caption);
  return text.empty() ? text : "<section>\n" + text + "</section>\n";
}

std::string plots_html(const ShownFile& shown) {
  if (shown.plots.empty()) return "";
  std::string text = "<section>\n<div class=\"figures\">\n";
  for (const report::LinePlot& plot : shown.plots) {
    std::string picture = line_plot(plot);
    if (picture.empty()) picture = "<p>no numbers</p>";
    text += fmt::format("<figure{}><b>{}</b>{}</figure>\n",
                        plot.width > kColumn ? " style=\"grid-column: 1 / -1\"" : "",
                        escape(plot.description),
                        picture);
  }
  return text + "</div>\n</section>\n";
}

}  // namespace

std::string shown_page(const std::filesystem::path& file, const ShownFile& shown) {
  std::string text = report::page_begin(file.filename().string());
  text += fmt::format("<h1>{}</h1>\n<p>{}</p>\n<p>{}</p>\n",
                      escape(file.filename().string()),
                      escape(shown.kind),
                      escape(file.string()));
  for (const std::string& fact : shown.facts) text += "<p>" + escape(fact) + "</p>\n";
  text += pictures_html(shown);
  text += plots_html(shown);
  for (const ShownTable& table : shown.tables) text += table_html(table);
  return text.append(report::kPageEnd);
}

}  // namespace latsch::cli
