// SPDX-License-Identifier: Apache-2.0
#include "correlation/study/settings/campaign_settings.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "base/text.h"
#include "base/unit_reading.h"
#include "base/units.h"
#include "correlation/study/study.h"
#include "experiment/language/usual_numbers.h"
#include "measurement/meaning/channel_checks.h"
#include "measurement/meaning/natural_unit.h"

namespace latsch::correlation {
namespace {

constexpr long kFewestCampaignRuns = 10, kMostCampaignRuns = 1000;
constexpr long kMostGridLevels = 50;
constexpr double kDearestChange = 1e4;  // tests; a dearer change is a mistake in writing

std::vector<std::string> test_names(const Study& study) {
  std::vector<std::string> names;
  for (const StudyTest& test : study.tests)
    if (!test.name.empty() && !test.is_own) names.push_back(test.name);
  return names;
}

/// Returns the test whose settings move, with its keys.
std::shared_ptr<const experiment::MovableTest> read_moved_test(
    const Node& table, const Node& root, const Study& study, const experiment::Language& language) {
  if (!study.specimens->kind())
    table.reject("test",
                 "needs a model, whose tests have settings; an outside program has none that a "
                 "design could move");
  const std::vector<std::string> names = test_names(study);
  if (names.empty())
    table.reject("test", "names a [test.NAME] of the study, which has none: add one");
  const std::string name = table.choice("test", names);
  const auto found = std::find_if(
      study.tests.begin(), study.tests.end(), [&](const auto& test) { return test.name == name; });
  const Node keys = root.table("test").table(name);
  const std::filesystem::path folder = study.file.parent_path();
  if (!keys.has("file"))
    return std::make_shared<experiment::MovableTest>(
        experiment::TestKeys{keys, folder}, *found->test, language);
  const std::filesystem::path file = folder / keys.text("file");
  return std::make_shared<experiment::MovableTest>(
      experiment::TestKeys{Document::read(file).root(), file.parent_path()},
      *found->test,
      language);
}

/// Returns the unit in which the range of a setting is written.
std::string written_unit(const Node& settings, const std::string& name, const std::string& si) {
  try {
    const std::vector<std::string> texts = settings.texts(name);
    if (const auto quantity = parse_quantity(texts.front(), Unit::of(si)))
      return quantity->unit.text();
  } catch (const InputError&) {  // numbers, or a list with one unit
  }
  return si == "1" ? "1" : natural_unit(si);
}

/// Throws for an end of a range that the test does not accept.
void check_end(const Node& settings,
               const CampaignSetting& setting,
               const experiment::MovableTest& movable,
               double value) {
  // Names of states and those of the same quantity in tests whose magnitudes are known.
  const std::map<std::string, std::string> alike{
      {"Fz", "load"}, {"p", "pressure"}, {"Vx", "speed"}};
  const std::string last = setting.path.substr(setting.path.rfind('.') + 1);
  const auto known = alike.find(last);
  const auto* usual = experiment::usual_magnitude(known == alike.end() ? last : known->second,
                                                  movable.unit(setting.path));
  if (usual && experiment::judged(*usual, value) == experiment::Seen::impossible)
    settings.reject(setting.name,
                    fmt::format("has {}, but {}",
                                format_quantity(value, setting.unit, 5),
                                experiment::usual_in_words(*usual)));
  // A state that is a channel must be possible as one.
  Channels alone;
  alone.add({.name = last, .unit = movable.unit(setting.path), .values = {value}});
  for (const ChannelDoubt& doubt : doubts_about(alone))
    if (doubt.is_error)
      settings.reject(
          setting.name,
          fmt::format("has {}, which {}", format_quantity(value, setting.unit, 5), doubt.sentence));
  experiment::MovableTest moved = movable;
  moved.set(setting.path, value);
  try {
    moved.test();
  } catch (const InputError& error) {
    settings.reject(setting.name,
                    fmt::format("has {}, which the test does not accept: {}",
                                format_quantity(value, setting.unit, 5),
                                error.what()));
  }
}

std::vector<CampaignSetting> read_settings(const Node& table, const CampaignSettings& campaign) {
  const Node settings = table.table("settings");
  const experiment::MovableTest& movable = *campaign.movable;
  std::vector<CampaignSetting> all;
  for (const std::string& name : settings.keys()) {
    const auto path = movable.find(name);
    if (!path)
      settings.reject(name,
                      fmt::format("is not a number of the test {}{}; it has {}",
                                  campaign.test,
                                  did_you_mean(name, movable.names()),
                                  list_of(movable.names())));
    const std::string si = movable.unit(*path);
    const std::vector<double> ends = settings.quantities(name, si);
    if (ends.size() != 2 || !(ends[0] < ends[1]))
      settings.reject(name, "is no range, expected its two ends, the lower one first");
    all.push_back({name, *path, ends[0], ends[1], written_unit(settings, name, si)});
    for (const CampaignSetting& other : all)
      if (&other != &all.back() && other.path == *path)
        settings.reject(name, "is the same number as " + other.name);
    for (const double end : ends) check_end(settings, all.back(), movable, end);
  }
  if (all.empty())
    table.reject("settings", "is empty, expected ranges such as {load = [\"1 kN\", \"8 kN\"]}");
  if (std::ssize(all) > kMostCampaignSettings)
    table.reject(
        "settings",
        fmt::format("has {} ranges, expected at most {}", all.size(), kMostCampaignSettings));
  return all;
}

/// Returns the setting that a key of cost or grid names.
CampaignSetting& setting_named(const Node& table,
                               const std::string& key,
                               std::vector<CampaignSetting>& settings) {
  std::vector<std::string> names;
  for (CampaignSetting& setting : settings) {
    if (setting.name == key) return setting;
    names.push_back(setting.name);
  }
  table.reject(
      key, "is none of the settings" + did_you_mean(key, names) + "; there are " + list_of(names));
}

std::vector<RigLimit> read_limits(const Node& table, const CampaignSettings& campaign) {
  std::vector<RigLimit> limits;
  if (!table.has("limits")) return limits;
  const experiment::MovableTest& movable = *campaign.movable;
  std::vector<std::string> names = movable.names();
  for (const CampaignSetting& setting : campaign.settings)
    if (std::find(names.begin(), names.end(), setting.name) == names.end())
      names.push_back(setting.name);
  const LimitedNumbers numbers = [&](const std::string& name) -> std::optional<LimitedNumber> {
    const auto path = movable.find(name);
    if (!path) return std::nullopt;
    LimitedNumber number{-1, movable.value(*path), Unit::of(movable.unit(*path)).dimension()};
    for (std::size_t k = 0; k < campaign.settings.size(); ++k)
      if (campaign.settings[k].path == *path) number.setting = static_cast<int>(k);
    return number;
  };
  for (const std::string& text : table.texts("limits")) {
    auto limit = RigLimit::read(text, numbers, names);
    if (!limit)
      table.reject("limits", "has " + in_quotes(text) + ", which " + limit.failure().reason);
    limits.push_back(*std::move(limit));
  }
  return limits;
}

/// Returns the channels of the test that fitted experiments compare.
std::vector<std::string> compared_channels(const Study& study, const std::string& test) {
  std::vector<std::string> channels;
  for (const StudyExperiment& experiment : study.experiments) {
    if (!experiment.fitted) continue;
    const std::string compared = experiment.observable->compared(experiment.objective);
    for (const std::string& asked : experiment.observable->asks()) {
      if (test_of(asked) != test || asked != compared) continue;
      const std::string channel = asked.substr(test.size() + 1);
      if (std::find(channels.begin(), channels.end(), channel) == channels.end())
        channels.push_back(channel);
    }
  }
  return channels;
}

void read_measured_channels(const Node& table, const Study& study, CampaignSettings& campaign) {
  const std::unique_ptr<experiment::Test> test = campaign.movable->test();
  std::vector<std::string> names;
  for (const auto& channel : test->channels())
    if (channel.is_compared) names.push_back(channel.name);
  if (table.has("measures")) {
    campaign.measures = table.texts("measures");
    for (const std::string& name : campaign.measures)
      if (std::find(names.begin(), names.end(), name) == names.end())
        table.reject("measures",
                     "has " + in_quotes(name) + ", which is no channel of the test" +
                         did_you_mean(name, names) + "; it has " + list_of(names));
  } else {
    campaign.measures = compared_channels(study, campaign.test);
  }
  if (campaign.measures.empty())
    table.reject("measures",
                 fmt::format("is {}, expected channels of the test {} that a laboratory would "
                             "measure, some of {}",
                             table.has("measures")
                                 ? "empty"
                                 : "missing, and no fitted experiment compares a channel of the "
                                   "test",
                             campaign.test,
                             list_of(names)));
  const auto unit_of = [&](const std::string& name) {
    for (const auto& channel : test->channels())
      if (channel.name == name) return channel.unit;
    return std::string("1");
  };
  std::optional<Node> stated;
  try {
    stated = table.find_table("noise");
  } catch (const InputError&) {  // one noise for all channels
  }
  if (!stated) {
    const bool is_one = campaign.measures.size() == 1;
    const auto noise = read_noise(table, is_one ? unit_of(campaign.measures.front()) : "1");
    if (noise)
      for (const std::string& name : campaign.measures) campaign.noise[name] = *noise;
    return;
  }
  for (const std::string& name : stated->keys()) {
    if (std::find(campaign.measures.begin(), campaign.measures.end(), name) ==
        campaign.measures.end())
      stated->reject(name,
                     "is none of the measured channels" + did_you_mean(name, campaign.measures) +
                         "; there are " + list_of(campaign.measures));
    campaign.noise[name] = *read_noise(*stated, unit_of(name), name);
  }
}

void read_aim(const Node& table, const Study& study, CampaignSettings& campaign) {
  const std::string criterion = table.choice("criterion", {"D", "A", "I", "T", "c"}, "D");
  campaign.aim = criterion == "D"   ? CampaignAim::volume
                 : criterion == "A" ? CampaignAim::mean
                 : criterion == "I" ? CampaignAim::prediction
                 : criterion == "T" ? CampaignAim::distinction
                                    : CampaignAim::variable;
  const bool needs_of =
      campaign.aim == CampaignAim::prediction || campaign.aim == CampaignAim::variable;
  if (table.has("of") && !needs_of)
    table.reject("of", "belongs to criterion \"I\" or \"c\", not to \"" + criterion + "\"");
  if (table.has("against") && campaign.aim != CampaignAim::distinction)
    table.reject("against", "belongs to criterion \"T\", not to \"" + criterion + "\"");
  std::vector<std::string> names;
  if (campaign.aim == CampaignAim::prediction)
    for (const StudyExperiment& experiment : study.experiments) names.push_back(experiment.name);
  if (campaign.aim == CampaignAim::variable)
    for (const DesignVariable& variable : study.space.variables()) names.push_back(variable.name);
  if (needs_of) {
    if (!table.has("of"))
      table.reject("of",
                   fmt::format("is missing beside criterion = \"{}\", expected the {}; there "
                               "are {}",
                               criterion,
                               campaign.aim == CampaignAim::prediction
                                   ? "experiment whose values are to be predicted"
                                   : "variable that is to be determined",
                               list_of(names)));
    campaign.of = table.text("of");
    if (std::find(names.begin(), names.end(), campaign.of) == names.end())
      table.reject("of",
                   "is " + in_quotes(campaign.of) + did_you_mean(campaign.of, names) +
                       ", expected one of " + list_of(names));
  }
  if (campaign.aim != CampaignAim::distinction) return;
  if (!table.has("against"))
    table.reject("against",
                 "is missing beside criterion = \"T\", expected the file of a study whose model "
                 "is the rival");
  campaign.against = (study.file.parent_path() / table.text("against")).lexically_normal();
  if (!std::filesystem::exists(campaign.against))
    table.reject("against",
                 "is " + in_quotes(table.text("against")) +
                     ", which does not exist in the folder of the study");
}

}  // namespace

std::string in_words(CampaignAim aim) {
  switch (aim) {
    case CampaignAim::volume:
      return "the volume of the confidence region (D)";
    case CampaignAim::mean:
      return "the mean variance of the variables, in ranges (A)";
    case CampaignAim::prediction:
      return "the mean variance of predicted values (I)";
    case CampaignAim::distinction:
      return "what a rival model cannot fit (T)";
    case CampaignAim::variable:
      return "the variance of one variable (c)";
  }
  return "";
}

std::vector<double> CampaignSettings::values_at(const std::vector<double>& places) const {
  std::vector<double> values;
  for (std::size_t k = 0; k < settings.size(); ++k) values.push_back(settings[k].at(places[k]));
  return values;
}

bool CampaignSettings::admits(const std::vector<double>& values) const {
  return std::all_of(
      limits.begin(), limits.end(), [&](const RigLimit& limit) { return limit.holds(values); });
}

CampaignSettings read_campaign(const Node& table,
                               const Node& root,
                               const Study& study,
                               const experiment::Language& language) {
  CampaignSettings campaign;
  campaign.movable = read_moved_test(table, root, study, language);
  campaign.test = table.text("test");
  campaign.settings = read_settings(table, campaign);
  campaign.limits = read_limits(table, campaign);
  read_measured_channels(table, study, campaign);
  read_aim(table, study, campaign);
  if (const auto cost = table.find_table("cost")) {
    for (const std::string& key : cost->keys()) {
      CampaignSetting& setting = setting_named(*cost, key, campaign.settings);
      setting.cost = cost->quantity(key, "1", Range::between(0.0, kDearestChange));
      campaign.has_costs = campaign.has_costs || setting.cost > 0.0;
    }
  }
  if (const auto grid = table.find_table("grid"))
    for (const std::string& key : grid->keys())
      setting_named(*grid, key, campaign.settings).grid =
          static_cast<int>(grid->integer(key, 1, kMostGridLevels));
  campaign.count = static_cast<int>(table.integer("count", 1, kMostCampaignTests, campaign.count));
  if (table.has("runs"))
    campaign.runs = static_cast<int>(table.integer("runs", kFewestCampaignRuns, kMostCampaignRuns));
  return campaign;
}

}  // namespace latsch::correlation
