// SPDX-License-Identifier: Apache-2.0
#include "report/tables.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "report/html_text.h"

namespace latsch::report {
namespace {

// share of a variable's range; a value closer to a bound counts as at the bound
constexpr double kBoundShare = 0.005;

double share_of_range(const Variable& v, double value) {
  if (v.logarithmic && v.lower > 0.0)
    return std::log(value / v.lower) / std::log(v.upper / v.lower);
  return (value - v.lower) / (v.upper - v.lower);
}

std::string number_cell(const std::string& text, bool strong = false) {
  return fmt::format("<td class=\"n{}\">{}</td>", strong ? " strong" : "", text);
}

std::string key(const std::string& value, const std::string& words, const std::string& more = "") {
  return fmt::format(
      "<div><span>{}</span><b>{}</b><i>{}</i></div>", escape(words), escape(value), escape(more));
}

bool is_force(const ExperimentRow& row) { return row.kind == "load_deflection"; }
bool is_frequency(const ExperimentRow& row) { return row.kind == "modes"; }
bool is_curve(const ExperimentRow& row) { return row.kind == "curve"; }

std::string heading_of(const std::string& measure) { return measure == "mean" ? "Mean" : measure; }

/// Returns the mean or RMS error of the fitted experiments for which `of_kind` is true; nothing if
/// their measures differ. `measure` becomes the name of the measure.
std::optional<double> error_of_kind(const StudyReport& report,
                                    bool (*of_kind)(const ExperimentRow&),
                                    std::string& measure) {
  double sum = 0.0;
  int count = 0;
  measure = "";
  for (const ExperimentRow& row : report.experiments) {
    if (!row.fitted || !of_kind(row)) continue;
    if (!measure.empty() && row.measure != measure) return std::nullopt;
    measure = row.measure;
    sum += (measure == "RMS" ? row.error * row.error : row.error) * row.values;
    count += row.values;
  }
  if (measure == "RMS") return std::sqrt(sum / count);
  if (measure == "mean") return sum / count;
  return std::nullopt;
}

/// Draws the range of a variable: its bounds as the ends of a line, the initial value as a ring,
/// the fitted value as a dot.
std::string track(const Variable& v) {
  const auto left = [&](double value) {
    const double share = share_of_range(v, value);
    return std::isfinite(share) ? 100.0 * std::clamp(share, 0.0, 1.0) : 0.0;
  };
  return fmt::format(
      "<span class=\"track\"><s style=\"left:{:.1f}%\"></s><u style=\"left:{:.1f}%\"></u></span>",
      left(v.initial),
      left(v.found));
}

}  // namespace

AtBound at_bound(const Variable& variable) {
  if (!(variable.upper > variable.lower)) return AtBound::no;
  const double share = share_of_range(variable, variable.found);
  if (share < kBoundShare) return AtBound::lower;
  return share > 1.0 - kBoundShare ? AtBound::upper : AtBound::no;
}

std::string check_table(const StudyReport& report) {
  std::string html =
      "<div class=\"scroll\"><table><thead><tr><th>Check</th><th>Of</th><th class=\"n\">Value</th>"
      "<th class=\"n\">Limit</th><th>Accepted</th><th>Source of the "
      "limit</th></tr></thead><tbody>\n";
  for (const CheckRow& row : report.checks) {
    html +=
        fmt::format("<tr><td>{}</td><td>{}</td>{}{}<td>{}</td><td class=\"quiet\">{}</td></tr>\n",
                    escape(row.check),
                    escape(row.what),
                    number_cell(escape(row.reason.empty() ? row.value : row.reason), true),
                    number_cell(escape(row.limit)),
                    row.accepted ? "yes" : "<span class=\"flag\">no</span>",
                    escape(row.source));
  }
  return html + "</tbody></table></div>";
}

std::string key_numbers(const StudyReport& report) {
  if (!report.checks.empty()) {
    const auto accepted = std::count_if(report.checks.begin(),
                                        report.checks.end(),
                                        [](const CheckRow& row) { return row.accepted; });
    return "<div class=\"key\">" +
           key(fmt::format("{} of {}", accepted, report.checks.size()), "Accepted") + "</div>\n";
  }
  const std::string kind = report.is_of_design ? "compared " : "fitted ";
  std::string html = "<div class=\"key\">";
  std::string about = report.target_in_words;
  if (report.initial_target)
    about += (about.empty() ? "" : "; ") + small_percent(*report.initial_target) + " at the start";
  html += key(small_percent(report.target), "Target", about);
  std::string measure;
  if (const auto dF = error_of_kind(report, is_force, measure))
    html += key(small_percent(*dF), heading_of(measure) + " |ΔF|", kind + "forces");
  if (const auto df = error_of_kind(report, is_frequency, measure))
    html += key(small_percent(*df), heading_of(measure) + " |Δf|", kind + "frequencies");
  if (const auto dy = error_of_kind(report, is_curve, measure))
    html +=
        key(small_percent(*dy), heading_of(measure) + " error", kind + "curves, of their scale");
  if (report.run) {
    const RunFacts& run = *report.run;
    html += key(std::to_string(run.trials),
                "Trials",
                run.failures ? fmt::format("{} failed", run.failures) : "none failed");
    html += key(duration(run.wall_time),
                "Time in trials",
                fmt::format("{} worker{}, {} CPU",
                            run.workers,
                            run.workers == 1 ? "" : "s side by side",
                            duration(run.cpu_time)));
  }
  return html + "</div>\n";
}

std::string variable_table(const StudyReport& report) {
  std::string html = fmt::format(
      "<div class=\"scroll\"><table><thead><tr><th>Variable</th><th class=\"n\">Initial</th><th "
      "class=\"n\">{}</th>"
      "<th class=\"n\">Lower</th><th>Range</th><th "
      "class=\"n\">Upper</th><th>Unit</th></tr></thead><tbody>\n",
      report.is_of_design ? "Best trial" : "Found");
  for (const Variable& v : report.variables) {
    const AtBound bound = at_bound(v);
    const auto number = [&](double si) { return significant(in_unit(si, v.unit), 4); };
    html += fmt::format("<tr><td>{}{}{}</td>{}{}{}<td>{}</td>{}<td>{}</td></tr>\n",
                        escape(v.name),
                        bound == AtBound::no ? "" : "<span class=\"flag\">at bound</span>",
                        v.logarithmic ? " <span class=\"quiet\">log</span>" : "",
                        number_cell(number(v.initial)),
                        number_cell(v.known.empty() ? number(v.found) : true_minus(v.known), true),
                        number_cell(number(v.lower)),
                        track(v),
                        number_cell(number(v.upper)),
                        v.unit == "1" ? "" : escape(typeset_unit(v.unit)));
  }
  html += "</tbody></table></div>";
  const bool flagged = std::any_of(report.variables.begin(),
                                   report.variables.end(),
                                   [](const Variable& v) { return at_bound(v) != AtBound::no; });
  if (flagged)
    html +=
        "<p class=\"quiet\">At bound: the best value may lie outside the range that was "
        "allowed.</p>";
  return html;
}

std::string experiment_table(const StudyReport& report) {
  const bool initial = std::any_of(
      report.experiments.begin(), report.experiments.end(), [](const ExperimentRow& row) {
        return row.initial_error.has_value();
      });
  const bool staged = std::any_of(report.experiments.begin(),
                                  report.experiments.end(),
                                  [](const auto& row) { return !row.own_stage.empty(); });
  std::string html = fmt::format(
      "<div "
      "class=\"scroll\"><table><thead><tr><th>Experiment</th><th>Conditions</th><th>Compared</"
      "th><th>Use</th>"
      "<th class=\"n\">Weight</th><th class=\"n\">Values</th>{}<th class=\"n\">Error</th>"
      "<th class=\"n\">Largest</th>{}<th class=\"n\">Own "
      "target</th></tr></thead><tbody>\n",
      initial ? "<th class=\"n\">Initial error</th>" : "",
      staged ? "<th class=\"n\">Best earlier stage</th>" : "");
  for (const ExperimentRow& row : report.experiments) {
    html += fmt::format(
        "<tr><td>{}<br><span "
        "class=\"quiet\">{}</span></td><td>{}</td><td>{}</td><td>{}</td>{}{}{}{}{}{}{}</tr>\n",
        escape(row.name),
        escape(row.kind),
        escape(row.conditions),
        escape(row.compared),
        !row.fitted           ? "predicted"
        : report.is_of_design ? "compared"
                              : "fitted",
        number_cell(row.fitted ? significant(row.weight, 3) : ""),
        number_cell(std::to_string(row.values)),
        initial ? number_cell(row.initial_error ? small_percent(*row.initial_error) : "") : "",
        number_cell(escape(row.measure) + " " + small_percent(row.error) +
                        (row.is_spoiled ? " (worse than before)" : ""),
                    true),
        number_cell(small_percent(row.largest_error)),
        staged ? number_cell(row.own_stage.empty() ? ""
                                                   : small_percent(row.own_stage_error) + ", " +
                                                         escape(row.own_stage))
               : "",
        number_cell(small_percent(row.value)));
  }
  html += "</tbody></table></div>";
  if (!report.target_definition.empty()) {
    html += fmt::format("<p class=\"quiet\">{}</p>", escape(report.target_definition));
  }
  return html;
}

std::string found_minima(const RunFacts& run) {
  std::string html =
      "<h3>Minima that the search found</h3><div class=\"scroll\"><table><thead><tr>"
      "<th class=\"n\">Target</th><th class=\"n\">Points that belong to it</th>";
  for (const std::string& name : run.variables) html += "<th class=\"n\">" + escape(name) + "</th>";
  html += "</tr></thead><tbody>\n";
  for (const FoundMinimum& one : run.minima) {
    html +=
        fmt::format("<tr>{}{}",
                    number_cell(small_percent(one.target)),
                    number_cell(fmt::format(
                        "{}{}", one.times_found, one.has_ended ? "" : ", search stopped early")));
    for (const std::string& value : one.place) html += number_cell(value);
    html += "</tr>\n";
  }
  return html + "</tbody></table></div>";
}

std::string run_facts(const StudyReport& report) {
  if (!report.run) return "";
  const RunFacts& run = *report.run;
  std::string html = "<div class=\"scroll\"><table><tbody>";
  const auto row = [&html](const std::string& words, const std::string& value) {
    html += fmt::format(
        "<tr><td class=\"quiet\">{}</td><td>{}</td></tr>\n", escape(words), escape(value));
  };
  if (!run.method.empty()) row("Method", run.method);
  if (!run.ended.empty()) row("Ended", run.ended);
  for (const std::string& test : run.tests) row("Its test", test);
  row("Trials", fmt::format("{}, of which {} failed", run.trials, run.failures));
  row("Time in trials",
      fmt::format("{} with {} worker{}, {} CPU in all, {} CPU a trial",
                  duration(run.wall_time),
                  run.workers,
                  run.workers == 1 ? "" : "s",
                  duration(run.cpu_time),
                  duration(run.cpu_time / std::max(1, run.trials))));
  if (run.program_time > 0.0) row("In outside programs", duration(run.program_time) + " CPU");
  for (const auto& [reason, count] : run.failure_reasons)
    row(fmt::format("Failed {} ×", count), reason);
  html += "</tbody></table></div>";
  return run.minima.empty() ? html : html + found_minima(run);
}

std::string discretization_table(const StudyReport& report) {
  std::string html =
      "<p class=\"lead\">How far the mesh of the fit is from the converged tire; the found values "
      "absorb this error.</p>"
      "<div class=\"scroll\"><table><thead><tr><th>Quantity</th><th class=\"n\">Error of the "
      "mesh</th></tr></thead><tbody>\n";
  for (const DiscretizationError& row : report.discretization) {
    html += fmt::format(
        "<tr><td>{}</td>{}</tr>\n", escape(row.quantity), number_cell(signed_percent(row.error)));
  }
  return html + "</tbody></table></div>";
}

}  // namespace latsch::report
