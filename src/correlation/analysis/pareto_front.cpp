// SPDX-License-Identifier: Apache-2.0
#include "correlation/analysis/pareto_front.h"

#include <fmt/format.h>

#include <algorithm>
#include <tuple>

#include "base/text.h"
#include "base/units.h"
#include "correlation/analysis/identifiability.h"
#include "correlation/target/study_trials.h"
#include "report/html_text.h"
#include "report/page_style.h"
#include "report/svg_plot.h"

namespace latsch::correlation {
namespace {

const StudyExperiment& find(const Study& study, const std::string& name) {
  std::vector<std::string> fitted;
  for (const StudyExperiment& experiment : study.experiments) {
    if (experiment.fitted && experiment.name == name) return experiment;
    if (experiment.fitted) fitted.push_back(experiment.name);
  }
  throw InputError({study.file.string(), 0},
                   "has no fitted experiment " + in_quotes(name) +
                       ", whose channels the journal would keep; it has " + list_of(fitted));
}

double part(const Study& study, const StudyExperiment& experiment, const Channels& channels) {
  return compare(experiment, study.experiments, channels).value;
}

std::vector<ParetoTrial> all_trials(const Study& study,
                                    const Journal& journal,
                                    const StudyExperiment& a,
                                    const StudyExperiment& b) {
  const Objective target = objective(study);
  std::vector<ParetoTrial> trials;
  journal.for_each_asked([&](const Trial& trial) {
    if (!trial.outcome.result || !study.space.contains(trial.point)) return;
    const Channels& channels = *trial.outcome.result;
    const auto score = target(trial.point, channels);
    if (!score || violation(*score) > kFulfilled) return;
    trials.push_back(
        {trial.point, part(study, a, channels), part(study, b, channels), score->value});
  });
  return trials;
}

/// Returns the name of the trial with the least target: "best", or "nearest" if no search has
/// looked for the best one.
std::string least_in_words(const ParetoFront& found) {
  return found.no_best.empty() ? "best" : "nearest";
}

constexpr double kWidth = 620.0, kHeight = 400.0, kLeft = 70.0, kBottom = 50.0, kMargin = 20.0;

std::string picture(const ParetoFront& found) {
  using namespace report;
  std::vector<double> as, bs;
  for (const auto& trial : found.front) {
    as.push_back(100.0 * trial.a);
    bs.push_back(100.0 * trial.b);
  }
  // The axes extend to twice the range of the front, because distant trials would shrink it to a
  // point.
  const double a_most = 2.0 * *std::max_element(as.begin(), as.end());
  const double b_most = 2.0 * *std::max_element(bs.begin(), bs.end());
  as.push_back(a_most);
  bs.push_back(b_most);
  const Axis x = Axis::around(as, kLeft, kWidth - kMargin, true);
  const Axis y = Axis::around(bs, kHeight - kBottom, kMargin, true);
  Svg svg(kWidth, kHeight, "Trials by the errors of two experiments, and their Pareto front");
  draw_frame(svg, x, y, found.a + " [%]", found.b + " [%]");
  const auto at = [&](const ParetoTrial& trial) {
    return report::Point(x.at(100.0 * trial.a), y.at(100.0 * trial.b));
  };
  for (const auto& trial : found.others) {
    if (100.0 * trial.a > x.upper() || 100.0 * trial.b > y.upper()) continue;
    svg.circle(at(trial), 2.0, R"(class="soft" fill="none")");
  }
  std::vector<report::Point> line;
  for (const auto& trial : found.front) line.push_back(at(trial));
  svg.polyline(line, R"(class="ink" fill="none")");
  for (const auto& trial : found.front) {
    svg.circle(at(trial),
               3.5,
               R"(fill="#2166ac")",
               fmt::format("{:.4g} %, {:.4g} %", 100.0 * trial.a, 100.0 * trial.b));
  }
  if (100.0 * found.best.a <= x.upper() && 100.0 * found.best.b <= y.upper()) {
    svg.circle(at(found.best),
               6.0,
               R"(fill="none" stroke="#b2182b" stroke-width="2")",
               least_in_words(found) + " by the weights of the study");
  }
  return svg.str();
}

/// Returns the values of a trial in their units, with the digits that the uncertainty supports, or
/// with five digits if the uncertainty is not known.
std::vector<std::string> values_of(const Study& study,
                                   const DesignPoint& point,
                                   const std::optional<Identifiability>& what) {
  std::vector<std::string> texts;
  for (int i = 0; i < study.space.size(); ++i) {
    const auto interval = interval_of(study, what, point, i);
    const double value = point.values[i];
    texts.push_back(interval ? value_text(study.space, i, value, *interval)
                             : format_quantity(value, study.space[i].unit, 5));
  }
  return texts;
}

std::string row(const ParetoTrial& trial,
                const std::vector<std::string>& values,
                const std::string& remark) {
  std::string cells = fmt::format("<td>{:.4f}</td><td>{:.4f}</td><td>{:.4f}</td>",
                                  100.0 * trial.a,
                                  100.0 * trial.b,
                                  100.0 * trial.target);
  for (const std::string& value : values) cells += "<td>" + report::escape(value) + "</td>";
  return fmt::format("<tr>{}<td>{}</td></tr>\n", cells, remark);
}

}  // namespace

ParetoFront pareto_front(const Study& study,
                         const Journal& journal,
                         const std::string& a,
                         const std::string& b) {
  std::vector<ParetoTrial> trials = all_trials(study, journal, find(study, a), find(study, b));
  if (trials.empty()) {
    throw InputError({study.run.journal.string(), 0},
                     "has no trial that succeeded and fulfills all constraints");
  }
  ParetoFront found{.a = a, .b = b};
  found.best = *std::min_element(trials.begin(), trials.end(), [](const auto& s, const auto& t) {
    return s.target < t.target;
  });
  std::stable_sort(trials.begin(), trials.end(), [](const auto& s, const auto& t) {
    return std::tie(s.a, s.b) < std::tie(t.a, t.b);
  });
  found.best_values = values_of(study, found.best.point, recorded_identifiability(study, journal));
  for (ParetoTrial& trial : trials) {
    const bool is_better = found.front.empty() || trial.b < found.front.back().b;
    (is_better ? found.front : found.others).push_back(std::move(trial));
  }
  return found;
}

std::string pareto_page(const Study& study, const ParetoFront& found) {
  using report::escape;
  std::string page = report::page_begin(study.title);
  page += fmt::format(
      "<h1>{}: {} against {}</h1>\n", escape(study.title), escape(found.a), escape(found.b));
  page += fmt::format(
      "<p>{} trials; on the line no trial is better in both. The ring is the {} one by the weights "
      "of the study.{}</p>\n{}\n",
      found.front.size() + found.others.size(),
      least_in_words(found),
      found.no_best.empty() ? "" : " Warning: " + escape(found.no_best),
      picture(found));
  page += fmt::format("<table>\n<tr><th>{} [%]</th><th>{} [%]</th><th>target [%]</th>",
                      escape(found.a),
                      escape(found.b));
  for (const DesignVariable& variable : study.space.variables()) {
    page += "<th>" + escape(variable.name) + "</th>";
  }
  page += "<th></th></tr>\n";
  for (const ParetoTrial& trial : found.front) {
    const bool is_best = trial.point == found.best.point;
    page += row(trial,
                is_best ? found.best_values : values_of(study, trial.point, std::nullopt),
                is_best ? least_in_words(found) : "");
  }
  return page + "</table>\n" + std::string(report::kPageEnd);
}

}  // namespace latsch::correlation
