// SPDX-License-Identifier: Apache-2.0
#include "cli/verbs/campaign/design_text.h"

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
#include "correlation/campaign/campaign_files.h"
#include "measurement/meaning/natural_unit.h"

namespace latsch::cli {
namespace {

using correlation::Campaign;
using correlation::CampaignAim;
using correlation::CampaignSetting;
using correlation::CampaignSettings;
using correlation::CampaignStanding;
using correlation::CampaignStart;
using correlation::Study;

constexpr double kInterval = 1.96;  // half width of a 95 % interval, in deviations
// Half width, in ranges, from which on an interval is the range itself.
constexpr double kWholeRange = 0.5;

std::string shown_setting(const CampaignSetting& setting, double value) {
  constexpr int kDigits = 5;
  const std::string number = format_number(Unit::of(setting.unit).from_si(value), kDigits);
  return setting.unit == "1" ? number : number + " " + setting.unit;
}

/// Returns the numbers of the test that no setting moves: "Vx 40.2 km/h".
std::vector<std::string> held_numbers(const CampaignSettings& settings) {
  std::vector<std::string> held;
  for (const std::string& name : settings.movable->names()) {
    const std::string path = *settings.movable->find(name);
    const bool is_moved = std::any_of(settings.settings.begin(),
                                      settings.settings.end(),
                                      [&](const auto& one) { return one.path == path; });
    if (is_moved) continue;
    const std::string unit = natural_unit(settings.movable->unit(path));
    held.push_back(name + " " + format_quantity(settings.movable->value(path), unit, 4));
  }
  return held;
}

/// Returns half the width of the interval of a variable, in its unit; not finite if it is the whole
/// range.
double half_width(const Study& study, const CampaignStart& start, std::size_t k, double deviation) {
  const double half = kInterval * deviation;
  if (half >= kWholeRange) return std::nan("");
  const auto i = static_cast<std::size_t>(start.free[k]);
  std::vector<double> low = study.space.to_unit(start.point), high = low;
  const double center = std::clamp(low[i], half, 1.0 - half);
  low[i] = center - half;
  high[i] = center + half;
  const Unit unit = Unit::of(study.space[static_cast<int>(i)].unit);
  return 0.5 * (unit.from_si(study.space.from_unit(high).values[i]) -
                unit.from_si(study.space.from_unit(low).values[i]));
}

std::string half_width_text(double half) {
  return std::isfinite(half) ? "+-" + format_number(half, 2) : "its range";
}

/// Returns the mean over the free variables of the deviation over that before the campaign.
double mean_shrinkage(const Campaign& campaign, const CampaignStanding& standing) {
  return standing.deviations.cwiseQuotient(campaign.standings.front().deviations).mean();
}

Json finite_or_null(double value) { return std::isfinite(value) ? Json(value) : Json(); }

}  // namespace

void print_design_ground(const Study& study, const CampaignStart& start, const Campaign& campaign) {
  const CampaignSettings& settings = *study.campaign;
  const auto test = settings.movable->test();
  say("{} tests like {}, chosen for {}{}\n",
      campaign.tests.size(),
      settings.test,
      in_words(settings.aim),
      settings.of.empty() ? "" : ": " + settings.of);
  say("{}\n",
      campaign.draws > 0
          ? fmt::format("The criterion is its mean over {} samples of the posterior density.",
                        campaign.draws)
      : start.is_fitted ? "The criterion is that at the fit alone."
                        : "Nothing is fitted: the criterion is that at the initial values, with "
                          "the priors.");
  for (std::size_t c = 0; c < settings.measures.size(); ++c) {
    std::string unit = "1";
    for (const auto& channel : test->channels())
      if (channel.name == settings.measures[c]) unit = channel.unit;
    say("Measured is {} with a noise of {}, {}.\n",
        settings.measures[c],
        format_quantity(campaign.deviations[c], unit, 3),
        start.noise[c].is_stated
            ? start.noise[c].noise.relative > 0.0
                  ? fmt::format("as stated; its largest value inside the limits is {}",
                                format_quantity(campaign.largest[c], unit, 4))
                  : "as stated"
            : "that of the fitted values");
  }
  if (settings.movable->assumed().empty()) return;
  const std::vector<std::string> held = held_numbers(settings);
  say("The test is one state of its table{}{}.\n",
      held.empty() ? "" : ", with the medians of the table for what no setting moves: ",
      fmt::to_string(fmt::join(held, ", ")));
}

void print_campaign_tests(const Study& study, const Campaign& campaign) {
  const CampaignSettings& settings = *study.campaign;
  std::vector<std::size_t> widths;
  for (std::size_t i = 0; i < settings.settings.size(); ++i) {
    std::size_t width = settings.settings[i].name.size();
    for (const auto& test : campaign.tests)
      width = std::max(width, shown_setting(settings.settings[i], test.values[i]).size());
    widths.push_back(width);
  }
  say("\n  test");
  for (std::size_t i = 0; i < widths.size(); ++i)
    say("  {:>{}}", settings.settings[i].name, widths[i]);
  say("  rank\n");
  for (std::size_t k = 0; k < campaign.tests.size(); ++k) {
    const auto& test = campaign.tests[k];
    say("  {:>4}", k + 1);
    for (std::size_t i = 0; i < widths.size(); ++i)
      say("  {:>{}}", shown_setting(settings.settings[i], test.values[i]), widths[i]);
    say("  {:>4}{}\n",
        test.rank,
        test.replicate_of < 0 ? "" : fmt::format("  replicate of test {}", test.replicate_of + 1));
  }
  say("The rank is the order in which tests gain most. ");
  if (!settings.has_costs) {
    say("No setting has a cost, so the tests stand in this order.\n");
    return;
  }
  std::vector<std::string> changes;
  double cost = 0.0, by_rank = 0.0;
  for (std::size_t i = 0; i < widths.size(); ++i) {
    changes.push_back(fmt::format("{} {}", settings.settings[i].name, campaign.changes[i]));
    cost += settings.settings[i].cost * campaign.changes[i];
    by_rank += settings.settings[i].cost * campaign.changes_by_rank[i];
  }
  say("Tests stand so that changes cost little: {} changes, worth {:.4g} tests, and {:.4g} in the "
      "order of rank.\n",
      fmt::join(changes, ", "),
      cost,
      by_rank);
}

void print_standings(const Study& study, const CampaignStart& start, const Campaign& campaign) {
  const int width = name_width(study.space.variables());
  say("\n95 % intervals by the slopes\n  {:<{}} {:<14}", "", width, "value");
  for (const CampaignStanding& standing : campaign.standings)
    say(" {:>12}",
        standing.tests == 0 ? std::string("now") : fmt::format("after {}", standing.tests));
  say("\n");
  for (std::size_t k = 0; k < start.free.size(); ++k) {
    const DesignVariable& variable = study.space[start.free[k]];
    const double value = start.point.values[static_cast<std::size_t>(start.free[k])];
    say("  {:<{}} {:<14}", variable.name, width, shown(variable, value));
    for (const CampaignStanding& standing : campaign.standings)
      say(" {:>12}",
          half_width_text(
              half_width(study, start, k, standing.deviations[static_cast<Eigen::Index>(k)])));
    say("\n");
  }
  say("  {:<{}} {:<14}", "mean, over now", width, "");
  for (const CampaignStanding& standing : campaign.standings)
    say(" {:>12.3f}", mean_shrinkage(campaign, standing));
  say("\n");
  if (study.campaign->aim != CampaignAim::distinction) return;
  say("  {:<{}} {:<14}", "T of the rival", width, "");
  for (const CampaignStanding& standing : campaign.standings) say(" {:>12.4g}", standing.T);
  say("\nT is the sum of squares, in units of the noise, that the rival cannot fit if the model of "
      "the study is true.\n");
}

void print_worth(const Study& study, const Campaign& campaign) {
  const CampaignSettings& settings = *study.campaign;
  const std::size_t tests = campaign.tests.size();
  if (campaign.grid.points == 0) {
    say("\nNo point of the grid {} is admitted, so there is nothing to compare with.\n",
        fmt::join(campaign.grid.levels, " x "));
  } else {
    say("\nThe grid {} has {} points inside the limits. Intervals after the tests chosen here are "
        "{:.2f} times as wide, on average, as after {} tests spread over this grid.",
        fmt::join(campaign.grid.levels, " x "),
        campaign.grid.points,
        campaign.grid.interval_ratio,
        tests);
    if (settings.aim == CampaignAim::volume)
      say(" The grid would need {:.2f} times as many tests for the same volume, without what is "
          "known already.\n",
          campaign.grid.criterion_ratio);
    else if (settings.aim == CampaignAim::distinction)
      say(" The T of the grid is 1/{:.2f} of the one here.\n", campaign.grid.criterion_ratio);
    else
      say(" The criterion, of which less is better, is {:.2f} times as large on the grid.\n",
          campaign.grid.criterion_ratio);
  }
  if (campaign.rounding > 1.0 + 1e-3 || campaign.rounding < 1.0 - 1e-3)
    say("Rounding the settings changed the criterion by the factor {:.3f}.\n", campaign.rounding);
  if (campaign.ends > 0)
    say("At {} of {} ends of the intervals now the first three tests stay the first three.{}\n",
        campaign.ends_kept,
        campaign.ends,
        2 * campaign.ends_kept < campaign.ends
            ? " The design is a local one: make a few tests, fit, and design again."
            : "");
  else if (!campaign.why_no_ends.empty())
    say("The ranking was not looked at elsewhere: {}.\n", campaign.why_no_ends);
  if (campaign.failed > 0)
    warn(
        fmt::format("the model failed at {} settings inside the limits, which were left out; the "
                    "first one: {}",
                    campaign.failed,
                    campaign.first_failure));
  if (!campaign.idle.empty())
    warn(
        fmt::format("{} {} nothing that is measured: any value of {} range is as good; leave {} "
                    "out of settings, or measure another channel",
                    fmt::join(campaign.idle, ", "),
                    campaign.idle.size() == 1 ? "changes" : "change",
                    campaign.idle.size() == 1 ? "its" : "their",
                    campaign.idle.size() == 1 ? "it" : "them"));
  if (!campaign.untouched.empty())
    warn(
        fmt::format("neither the data nor {} tests at any settings tell as much as the bounds "
                    "about {}: {}",
                    tests,
                    campaign.untouched.size() == 1 ? "one direction" : "these directions",
                    fmt::join(campaign.untouched, "; ")));
}

void answer_design(const Study& study, const CampaignStart& start, const Campaign& campaign) {
  const CampaignSettings& settings = *study.campaign;
  for (std::size_t k = 0; k < campaign.tests.size(); ++k) {
    Json values = Json::object();
    for (std::size_t i = 0; i < settings.settings.size(); ++i)
      values[settings.settings[i].name] = {
          {"value",
           *parse_number(
               Unit::of(settings.settings[i].unit).exact_number(campaign.tests[k].values[i]))},
          {"unit", settings.settings[i].unit}};
    const int first = campaign.tests[k].replicate_of;
    answer()["tests"].push_back({{"settings", values},
                                 {"rank", campaign.tests[k].rank},
                                 {"replicate_of", first < 0 ? Json() : Json(first + 1)},
                                 {"file", correlation::campaign_test_file(campaign, k)}});
  }
  Json& variables = answer()["variables"] = Json::object();
  for (std::size_t k = 0; k < start.free.size(); ++k) {
    const DesignVariable& variable = study.space[start.free[k]];
    Json half = Json::array();
    for (const CampaignStanding& standing : campaign.standings)
      half.push_back(finite_or_null(
          half_width(study, start, k, standing.deviations[static_cast<Eigen::Index>(k)])));
    variables[variable.name] = {{"unit", variable.unit}, {"half_widths", half}};
  }
  for (const CampaignStanding& standing : campaign.standings) {
    answer()["after"].push_back(standing.tests);
    answer()["mean_over_now"].push_back(mean_shrinkage(campaign, standing));
    if (settings.aim == CampaignAim::distinction) answer()["T"].push_back(standing.T);
  }
  answer()["noise"] = campaign.deviations;
  answer()["draws"] = campaign.draws;
  answer()["grid"] = {{"levels", campaign.grid.levels},
                      {"points", campaign.grid.points},
                      {"interval_ratio", campaign.grid.interval_ratio},
                      {"criterion_ratio", campaign.grid.criterion_ratio}};
  answer()["changes"] = campaign.changes;
  answer()["rounding"] = campaign.rounding;
  answer()["ends"] = {{"looked_at", campaign.ends}, {"kept", campaign.ends_kept}};
  answer()["failed"] = campaign.failed;
  answer()["untouched"] = campaign.untouched;
  answer()["without_effect"] = campaign.idle;
}

}  // namespace latsch::cli
