// SPDX-License-Identifier: Apache-2.0
#include "cli/verbs/selection/selection_text.h"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <cmath>
#include <nlohmann/json.hpp>
#include <string>

#include "base/text.h"
#include "base/units.h"
#include "cli/console/console.h"
#include "cli/console/tables.h"
#include "correlation/analysis/identifiability.h"

namespace latsch::cli {
namespace {

using correlation::SelectionUnit;
using correlation::Study;
using correlation::StudySelection;

// Correlation from which on two candidates count as acting alike.
constexpr double kActAlike = 0.95;

bool is_kept(const SelectedModel& model, std::size_t unit) {
  return std::binary_search(model.units.begin(), model.units.end(), static_cast<int>(unit));
}

/// Returns the rise of dropping a unit alone, in the chosen model if it is kept there, else when it
/// was dropped.
double rise_of(const StudySelection& selected, std::size_t unit) {
  const SelectedModel& model = selected.chosen();
  if (!is_kept(model, unit)) return selected.selection.fates()[unit].rise;
  const auto at = std::find(model.units.begin(), model.units.end(), static_cast<int>(unit));
  return model.rises[static_cast<std::size_t>(at - model.units.begin())];
}

std::string number_or(double value, const std::string& otherwise) {
  return std::isfinite(value) ? fmt::format("{:.1f}", value) : otherwise;
}

/// Returns what happened to a unit: "kept", "dropped in round 2".
std::string verdict_of(const StudySelection& selected, std::size_t unit) {
  const UnitFate& fate = selected.selection.fates()[unit];
  if (!is_kept(selected.chosen(), unit)) return fmt::format("dropped in round {}", fate.round);
  if (fate.cannot_be_dropped) return "kept: the model fails without it";
  if (std::isnan(rise_of(selected, unit)))
    return fate.tested ? "kept, at a bound: tested" : "kept, at a bound: not tested";
  return "kept";
}

std::string rise_text(const StudySelection& selected, std::size_t unit) {
  const UnitFate& fate = selected.selection.fates()[unit];
  const double rise = rise_of(selected, unit);
  if (std::isnan(rise) && fate.tested) return fmt::format("{:.1f}", fate.tested_rise);
  return number_or(rise, "-");
}

std::vector<std::string> unit_names(const StudySelection& selected, const std::vector<int>& units) {
  std::vector<std::string> names;
  for (const int unit : units)
    names.push_back(selected.settings.units[static_cast<std::size_t>(unit)].name);
  return names;
}

/// Returns names, the first few of which are written out.
std::string few_of(const std::vector<std::string>& names) {
  constexpr std::size_t kWrittenOut = 6;
  if (names.size() <= kWrittenOut) return fmt::format("{}", fmt::join(names, ", "));
  return fmt::format("{} and {} more",
                     fmt::join(names.begin(), names.begin() + kWrittenOut, ", "),
                     names.size() - kWrittenOut);
}

const char* heading_of(SelectionCriterion criterion) {
  switch (criterion) {
    case SelectionCriterion::bic:
      return "BIC";
    case SelectionCriterion::aicc:
      return "AICc";
    case SelectionCriterion::cross_validation:
      break;
  }
  return "left out";
}

}  // namespace

void print_path(const StudySelection& selected) {
  const CountedValues& counted = selected.selection.rows().counted();
  say("{} candidate{}, {} measured values{}\n",
      selected.settings.units.size(),
      selected.settings.units.size() == 1 ? "" : "s",
      counted.values,
      counted.independent < counted.values
          ? fmt::format(", which count as {:.0f} because neighbors share noise",
                        counted.independent)
          : "");
  say("\n  {:>5} {:>9} {:>14} {:>10} {:>12}  dropped\n",
      "round",
      "variables",
      "rise expected",
      "rise",
      heading_of(selected.settings.criterion));
  const auto& path = selected.selection.path();
  const double least = selected.selection.criterion(selected.chosen());
  for (std::size_t k = 0; k < path.size(); ++k) {
    const SelectedModel& model = path[k];
    const double above = selected.selection.criterion(model) - least;
    say("{} {:>5} {:>9} {:>14} {:>10} {:>12}  {}{}{}\n",
        k == selected.selection.best() ? "*" : " ",
        model.round,
        model.coefficients,
        k == 0 ? "" : number_or(model.expected_rise, "-"),
        k == 0 ? "" : number_or(model.minus_two_log - path[k - 1].minus_two_log, "-"),
        std::isfinite(above) ? fmt::format("{:+.1f}", above) : "not known",
        few_of(unit_names(selected, model.dropped)),
        model.converged ? "" : " (not converged)",
        model.is_from_start ? " (better from the start values)" : "");
  }
  say("The criterion is told as the distance from the least one; * marks the choice. The rise is "
      "that of -2 ln L.\n");
}

void print_candidates(const Study& study, const StudySelection& selected) {
  const Confidence c = selected.intervals();
  const DesignPoint point = selected.point(study.space, selected.reported());
  const auto holding = correlation::holding_recordings(study, selected);
  const int width = name_width(study.space.variables());
  say("\n  {:<{}} {:<14} {:<28} {:>8}  verdict\n", "", width, "value", "95 %", "rise");
  for (std::size_t k = 0; k < selected.settings.units.size(); ++k) {
    const SelectionUnit& unit = selected.settings.units[k];
    const bool kept = is_kept(selected.chosen(), k);
    const UnitFate& fate = selected.selection.fates()[k];
    std::string verdict = verdict_of(selected, k);
    if (unit.variables.size() > 1) verdict += ", group " + unit.name;
    if (!kept && holding[k])
      verdict +=
          fmt::format("; {} once more would narrow it most, from {:.2g} to {:.2g} of its range",
                      holding[k]->recording,
                      holding[k]->before,
                      holding[k]->after);
    if (!kept && fate.alike >= 0 && std::abs(fate.correlation) >= kActAlike)
      verdict += fmt::format("; acts like {} (correlation {:.3f})",
                             selected.settings.units[static_cast<std::size_t>(fate.alike)].name,
                             fate.correlation);
    for (const int i : unit.variables) {
      const auto at = static_cast<std::size_t>(i);
      const Interval& interval = c.intervals[at];
      const std::string value =
          kept ? correlation::value_text(study.space, i, point.values[at], interval)
               : format_quantity(point.values[at], study.space[i].unit, 5);
      say("  {:<{}} {:<14} {:<28} {:>8}  {}\n",
          study.space[i].name,
          width,
          value,
          !kept                 ? "held"
          : std::isnan(c.sigma) ? "not known"
                                : correlation::interval_text(study.space, i, interval),
          rise_text(selected, k),
          verdict);
    }
  }
}

void print_ground(const Study& study, const StudySelection& selected) {
  const SelectionRows& rows = selected.selection.rows();
  if (selected.selection.passes() > 1)
    say("\nFits from the initial values ended lower than the path, so it was walked again from "
        "there; "
        "this is pass {}.\n",
        selected.selection.passes());
  if (selected.refit)
    say("\n{} chose; values and intervals are those of {} alone, which took no part in the "
        "choice.\n",
        fmt::format("{}", fmt::join(selected.choosing, ", ")),
        fmt::format("{}", fmt::join(selected.refitted, ", ")));
  else
    say("\nThe intervals of kept candidates know nothing of the choice, which the same values "
        "made: "
        "they hold less often than 95 %. honest = true in [selection] determines them from other "
        "recordings than those that choose.\n");
  if (!study.selection)
    say("The study has no [selection]: all variables are candidates, and a dropped one has its "
        "initial value.\n");
  if (rows.excess() > 1.0)
    warn(
        fmt::format("the residuals of all candidates together are {:.2g} times their stated noise, "
                    "so its size counts as unknown",
                    rows.excess()));
  if (rows.is_pattern())
    warn(
        "the residuals are a systematic misfit and no noise; the choice takes them for noise that "
        "neighbors share, and says which coefficients reduce it, not which are true");
  else if (!rows.is_white())
    say("Neighboring values share noise, as estimated at the fit of all candidates. The choice "
        "weighs the values by it and latsch run does not, so values may differ.\n");
  if (selected.selection.ending() == SelectionEnd::refits)
    warn(
        fmt::format("the limit of {} refits ended the path before BIC was {} above its least; a "
                    "model with fewer variables may be better; raise refits in [selection]",
                    selected.settings.refits,
                    60));
  std::vector<std::string> open;
  for (std::size_t k = 0; k < selected.selection.path().size(); ++k)
    if (!selected.selection.path()[k].converged)
      open.push_back(std::to_string(selected.selection.path()[k].round));
  if (!open.empty())
    warn(fmt::format("the fit of round{} {} did not converge, so its criterion may be too large",
                     open.size() == 1 ? "" : "s",
                     fmt::join(open, ", ")));
  const SelectedModel& reported = selected.reported();
  constexpr double kWorthTelling = 1.0;  // fall of -2 ln L
  const double promised =
      selected.chosen().is_flat ? selected.intervals().left_to_gain / rows.variance() : 0.0;
  if (promised > kWorthTelling)
    warn(fmt::format(
        "at the chosen model the slopes promise that -2 ln L falls by {:.1f}, but no step "
        "brings it: the fit lies in a curved valley, or variables are hardly determined",
        promised));
  if (selected.refit && !reported.converged)
    warn("the refit to the other half did not converge, so its values and intervals are not final");
}

void print_rivals(const Study& study,
                  const StudySelection& selected,
                  const std::vector<std::string>& experiments,
                  const std::vector<std::vector<double>>& errors) {
  const std::vector<std::size_t> rivals = selected.selection.rivals();
  const double least = selected.selection.criterion(selected.chosen());
  if (rivals.size() > 1) {
    say("\nModels within 2 of the best, which the values do not tell apart\n");
    for (std::size_t r = 0; r < rivals.size(); ++r) {
      const SelectedModel& model = selected.selection.path()[rivals[r]];
      std::vector<int> more, less;
      for (const int unit : model.units)
        if (!is_kept(selected.chosen(), static_cast<std::size_t>(unit))) more.push_back(unit);
      for (const int unit : selected.chosen().units)
        if (!is_kept(model, static_cast<std::size_t>(unit))) less.push_back(unit);
      say("  round {:<3} {:+.1f}  {} variables{}{}\n",
          model.round,
          selected.selection.criterion(model) - least,
          model.coefficients,
          more.empty() ? "" : ", with " + few_of(unit_names(selected, more)),
          less.empty() ? "" : ", without " + few_of(unit_names(selected, less)));
    }
  }
  if (errors.empty()) return;
  const int width = name_width(study.experiments);
  say("\nPredicted experiments, mean errors\n  {:<{}}", "", width);
  for (const std::size_t k : rivals)
    say(" {:>10}", fmt::format("round {}", selected.selection.path()[k].round));
  say("\n");
  for (std::size_t e = 0; e < experiments.size(); ++e) {
    say("  {:<{}}", experiments[e], width);
    for (const auto& of_rival : errors)
      say(" {:>10}",
          std::isfinite(of_rival[e]) ? fmt::format("{:.3g} %", 100.0 * of_rival[e]) : "failed");
    say("\n");
  }
}

void answer_selection(const Study& study,
                      const StudySelection& selected,
                      const std::vector<std::string>& experiments,
                      const std::vector<std::vector<double>>& errors) {
  const auto finite = [](double value) { return std::isfinite(value) ? Json(value) : Json(); };
  const CountedValues& counted = selected.selection.rows().counted();
  answer()["criterion"] = heading_of(selected.settings.criterion);
  answer()["values"] = counted.values;
  answer()["independent_values"] = counted.independent;
  answer()["refits"] = selected.selection.refits();
  answer()["passes"] = selected.selection.passes();
  answer()["trials"] = selected.trials;
  answer()["honest"] = selected.refit.has_value();
  answer()["choosing"] = selected.choosing;
  answer()["refitted"] = selected.refitted;
  for (const SelectedModel& model : selected.selection.path())
    answer()["path"].push_back({{"round", model.round},
                                {"variables", model.coefficients},
                                {"dropped", unit_names(selected, model.dropped)},
                                {"expected_rise", finite(model.expected_rise)},
                                {"minus_two_log", finite(model.minus_two_log)},
                                {"bic", finite(model.bic)},
                                {"aicc", finite(model.aicc)},
                                {"left_out", finite(model.left_out)},
                                {"converged", model.converged}});
  const Confidence c = selected.intervals();
  const DesignPoint point = selected.point(study.space, selected.reported());
  const auto value_at = [&](int i, double u) -> Json {
    if (!std::isfinite(u) || u < 0.0 || u > 1.0) return {};
    std::vector<double> all = study.space.to_unit(point);
    all[static_cast<std::size_t>(i)] = u;
    return Unit::of(study.space[i].unit)
        .from_si(study.space.from_unit(all).values[static_cast<std::size_t>(i)]);
  };
  for (std::size_t k = 0; k < selected.settings.units.size(); ++k) {
    const UnitFate& fate = selected.selection.fates()[k];
    const bool kept = is_kept(selected.chosen(), k);
    for (const int i : selected.settings.units[k].variables) {
      const auto at = static_cast<std::size_t>(i);
      answer()["candidates"].push_back(
          {{"name", study.space[i].name},
           {"candidate", selected.settings.units[k].name},
           {"unit", study.space[i].unit},
           {"kept", kept},
           {"round", kept ? Json() : Json(fate.round)},
           {"rise", finite(rise_of(selected, k))},
           {"tested_rise", fate.tested ? finite(fate.tested_rise) : Json()},
           {"value", Unit::of(study.space[i].unit).from_si(point.values[at])},
           {"interval",
            kept ? Json{value_at(i, c.intervals[at].lower), value_at(i, c.intervals[at].upper)}
                 : Json()}});
    }
  }
  const std::vector<std::size_t> rivals = selected.selection.rivals();
  for (std::size_t r = 0; r < rivals.size(); ++r) {
    Json predicted = Json::object();
    for (std::size_t e = 0; e < experiments.size() && r < errors.size(); ++e)
      predicted[experiments[e]] = finite(errors[r][e]);
    answer()["rivals"].push_back(
        {{"round", selected.selection.path()[rivals[r]].round},
         {"kept", unit_names(selected, selected.selection.path()[rivals[r]].units)},
         {"predicted_errors", predicted}});
  }
}

}  // namespace latsch::cli
