// SPDX-License-Identifier: Apache-2.0
#include "report/value_table.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "base/text.h"
#include "report/html_text.h"

namespace latsch::report {
namespace {

/// Weights below this share of the largest weight are shown as hardly fitted: twenty values with
/// this weight count as much as one with the largest.
constexpr double kNearZero = 0.05;

std::string cell(const std::string& text, bool strong = false) {
  return fmt::format("<td class=\"n{}\">{}</td>", strong ? " strong" : "", text);
}

double largest_weight(const StudyReport& report) {
  double largest = 0.0;
  for (const MeasuredValue& value : report.values)
    if (value.fitted) largest = std::max(largest, value.weight);
  return largest;
}

bool is_near_zero(const MeasuredValue& value, double largest) {
  return value.fitted && value.weight < kNearZero * largest;
}

bool has_interval(const MeasuredValue& value) {
  return value.lower && value.upper && std::isfinite(*value.lower) && std::isfinite(*value.upper);
}

/// Returns a number in the unit of its row, with as many digits as its interval supports.
std::string number(const MeasuredValue& value, double si) {
  constexpr int kDigits = 4;
  const double shown = in_unit(si, value.unit);
  if (!std::isfinite(shown)) return "–";
  if (!has_interval(value)) return significant(shown, kDigits);
  const double half = 0.5 * (in_unit(*value.upper, value.unit) - in_unit(*value.lower, value.unit));
  return half > 0.0 ? true_minus(format_known(shown, half)) : significant(shown, kDigits);
}

/// Returns the ratio of a value to its measured value, such as "3.68", a number that is usual in
/// tables of such fits.
std::string over_target(const MeasuredValue& value, double si) {
  const double ratio = si / value.measured;
  return std::isfinite(ratio) ? fixed(ratio, 2) : "–";
}

std::string row(const MeasuredValue& value, double largest) {
  std::string name = escape(value.name);
  if (is_near_zero(value, largest)) name += "<span class=\"flag\">weight near zero</span>";
  if (!value.compared.empty())
    name += fmt::format("<br><span class=\"quiet\">{}</span>", escape(value.compared));
  const std::string interval =
      has_interval(value) ? number(value, *value.lower) + " .. " + number(value, *value.upper)
                          : "–";
  return fmt::format(
      "<tr><td>{}</td>{}{}{}{}{}{}{}<td>{}</td></tr>\n",
      name,
      cell(value.fitted ? significant(value.weight, 3) : "predicted"),
      cell(significant(in_unit(value.measured, value.unit), 5)),
      cell(value.initial ? significant(in_unit(*value.initial, value.unit), 4) : "–"),
      cell(value.initial ? over_target(value, *value.initial) : "–"),
      cell(number(value, value.found), true),
      cell(over_target(value, value.found)),
      cell(interval),
      value.unit == "1" ? "" : escape(typeset_unit(value.unit)));
}

}  // namespace

std::string value_table(const StudyReport& report) {
  std::string html = fmt::format(
      "<div class=\"scroll\"><table><thead><tr><th>Value</th><th class=\"n\">Weight</th>"
      "<th class=\"n\">Target</th><th class=\"n\">Initial</th><th class=\"n\">of target</th>"
      "<th class=\"n\">{}</th><th class=\"n\">of target</th><th class=\"n\">95 % band</th>"
      "<th>Unit</th></tr></thead><tbody>\n",
      !report.checks.empty() ? "Computed"
      : report.is_of_design  ? "Best"
                             : "Optimized");
  const double largest = largest_weight(report);
  bool flagged = false;
  for (const MeasuredValue& value : report.values) {
    html += row(value, largest);
    flagged = flagged || is_near_zero(value, largest);
  }
  html += "</tbody></table></div>";
  if (std::any_of(report.values.begin(), report.values.end(), has_interval))
    html +=
        "<p class=\"quiet\">95 % band: of the computed value, as uncertain as the variables "
        "are.</p>";
  if (flagged)
    html += fmt::format(
        "<p class=\"quiet\">Weight near zero: less than {:g} % of the heaviest. Such a value "
        "hardly affects the fit, so its error says nothing about the model.</p>",
        100.0 * kNearZero);
  return html;
}

}  // namespace latsch::report
