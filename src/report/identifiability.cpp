// SPDX-License-Identifier: Apache-2.0
#include "report/identifiability.h"

#include <fmt/format.h>

#include <cmath>

#include "report/html_text.h"
#include "report/identifiability_plots.h"

namespace latsch::report {
namespace {

std::string figure(const std::string& heading,
                   const std::string& quiet,
                   const std::string& picture,
                   const std::string& caption) {
  const bool wide = picture.find("viewBox=\"0 0 520 ") == picture.npos;  // whole row
  return fmt::format("<figure{}><b>{} <span>{}</span></b>{}<figcaption>{}</figcaption></figure>\n",
                     wide ? " style=\"grid-column: 1 / -1\"" : "",
                     escape(heading),
                     escape(quiet),
                     picture,
                     escape(caption));
}

const ProfileCurve* profile_of(const IdentifiabilityPage& what, const std::string& variable) {
  for (const ProfileCurve& curve : what.profiles) {
    if (curve.variable == variable) return &curve;
  }
  return nullptr;
}

std::string interval_table(const IdentifiabilityPage& what) {
  const bool judged = !what.profiles.empty();
  std::string html = fmt::format(
      "<div class=\"scroll\"><table><thead><tr><th>Variable</th><th>Found</th><th>95 % interval, "
      "linear</th>{}{}</tr></thead><tbody>\n",
      what.shifts.empty() ? "" : "<th>Mesh and step</th>",
      judged ? "<th>95 % interval, profile</th><th>Verdict</th>" : "");
  for (size_t i = 0; i < what.variables.size(); ++i) {
    std::string more;
    if (!what.shifts.empty()) more = "<td>" + escape(typeset_words(what.shifts[i])) + "</td>";
    if (const ProfileCurve* curve = profile_of(what, what.variables[i])) {
      more += fmt::format("<td>{}</td><td>{}</td>",
                          escape(typeset_words(curve->interval)),
                          curve->verdict == "identifiable"
                              ? "identifiable"
                              : fmt::format("<b>{}</b>", escape(curve->verdict)));
    }
    html += fmt::format("<tr><td>{}</td><td>{}</td><td>{}</td>{}</tr>\n",
                        escape(what.variables[i]),
                        escape(typeset_words(what.values[i])),
                        escape(typeset_words(what.intervals[i])),
                        more);
  }
  return html + "</tbody></table></div>";
}

std::string left_out_table(const IdentifiabilityPage& what) {
  if (what.left_out.empty()) return "";
  std::string html =
      "<h3>Cross-validation <span>each experiment predicted from the fit of the others</span></h3>"
      "<div class=\"scroll\"><table><thead><tr><th>Left out</th><th class=\"n\">Error, fitted</th>"
      "<th class=\"n\">Error, predicted</th></tr></thead><tbody>\n";
  for (const LeftOutExperiment& row : what.left_out) {
    html +=
        fmt::format("<tr><td>{}</td><td class=\"n\">{}</td><td class=\"n\">{}</td></tr>\n",
                    escape(row.name),
                    percent(row.fitted),
                    std::isnan(row.predicted) ? "refit did not converge" : percent(row.predicted));
  }
  return html +
         "</tbody></table></div><p class=\"quiet\">Root mean square of the relative "
         "errors.</p>";
}

std::string band_table(const IdentifiabilityPage& what) {
  if (what.bands.empty()) return "";
  std::string html =
      "<h3>Computed values <span>how uncertain they are because the variables are: 95 % "
      "bands</span></h3><div class=\"scroll\"><table><thead><tr><th>Experiment</th><th>Use</th>"
      "<th>Widest band</th><th>Inside band and noise</th></tr></thead><tbody>\n";
  std::string remarks;
  for (const BandRow& row : what.bands) {
    html += fmt::format("<tr><td>{}</td><td>{}</td><td>{}</td><td>{}</td></tr>\n",
                        escape(row.experiment),
                        row.fitted ? "fitted" : "predicted",
                        row.widest.empty() ? "not known" : escape(typeset_words(row.widest)),
                        escape(row.inside));
    for (const std::string& remark : row.remarks)
      remarks +=
          fmt::format("<p class=\"quiet\">{}: {}.</p>", escape(row.experiment), escape(remark));
  }
  return html + "</tbody></table></div>" + remarks;
}

std::string gain_table(const IdentifiabilityPage& what) {
  if (what.gains.empty()) return "";
  std::string html =
      "<h3>What to measure next <span>the most useful first</span></h3><div "
      "class=\"scroll\"><table>"
      "<thead><tr><th>Measurement</th><th class=\"n\">Volume of the confidence region</th>"
      "<th>Helps most</th></tr></thead><tbody>\n";
  for (const Gain& gain : what.gains) {
    html += fmt::format("<tr><td>{}</td><td class=\"n\">1 / {}</td><td>{}</td></tr>\n",
                        escape(gain.measurement),
                        significant(gain.shrinkage, 3),
                        escape(gain.helps));
  }
  return html + "</tbody></table></div>";
}

std::string missed_list(const IdentifiabilityPage& what) {
  if (what.missed.empty()) return "";
  std::string html =
      "<h3>Missed values <span>by more than three times their noise, 1 % if none is stated; to "
      "first order</span></h3><ul>";
  for (const std::string& sentence : what.missed)
    html += fmt::format("<li>{}</li>", escape(sentence));
  return html + "</ul>";
}

}  // namespace

std::string identifiability_chapter(const IdentifiabilityPage& what) {
  std::string html =
      fmt::format("<p class=\"lead\">How well {} measured values{} determine {} variable{}.</p>",
                  what.residuals,
                  what.priors == 0 ? "" : fmt::format(" and {} priors", what.priors),
                  what.variables.size(),
                  what.variables.size() == 1 ? "" : "s");
  html += interval_table(what);
  for (const std::string& remark : what.remarks) {
    html += fmt::format("<p class=\"quiet\">{}</p>", escape(remark));
  }
  html += "<div class=\"figures\">";
  html += figure("Directions",
                 "from the best determined to the least",
                 spectrum_plot(what),
                 "A direction is a common change of the variables named. At 100 % of the range the "
                 "data say nothing about it.");
  if (what.variables.size() > 1) {
    html += figure("Correlations",
                   "",
                   correlation_plot(what),
                   "Near −1 or +1, the data determine two variables only together: one "
                   "compensates for the other.");
  }
  html += "</div>";
  if (!what.profiles.empty()) {
    html +=
        "<h3>Profiles <span>each variable held at other values, all others fitted anew; below "
        "the line at 1 lies its 95 % interval</span></h3><div class=\"figures\">";
    for (const ProfileCurve& curve : what.profiles) {
      html +=
          figure(curve.variable, curve.verdict, profile_plot(curve), "Dashed: the value found.");
    }
    html += "</div>";
  }
  return html + missed_list(what) + band_table(what) + left_out_table(what) + gain_table(what);
}

}  // namespace latsch::report
