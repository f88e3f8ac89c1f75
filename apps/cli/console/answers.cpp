// SPDX-License-Identifier: Apache-2.0
#include "cli/console/answers.h"

#include <algorithm>
#include <nlohmann/json.hpp>

#include "base/file.h"
#include "base/units.h"
#include "correlation/target/compared_trial.h"
#include "formats/tables/csv_table.h"

namespace latsch::cli {
namespace {

using correlation::Comparison;
using correlation::json_of;
using correlation::StudyExperiment;

Json in_unit_of(const DesignVariable& variable, double value) {
  return json_of(Unit::of(variable.unit).from_si(value));
}

}  // namespace

Json answer_of(const Channels& channels) {
  Json all = Json::array();
  for (const Channel& channel : channels.all()) {
    all.push_back(
        {{"name", channel.name}, {"unit", channel.unit}, {"values", json_of(channel.values)}});
  }
  return all;
}

void give(const Channels& channels, const std::string& file) {
  if (!file.empty()) {
    write_text_file(file, formats::csv_text(channels));
    say_written(file);
  } else if (answers_in_json()) {
    answer()["channels"] = answer_of(channels);
  } else {
    put(formats::csv_text(channels));
  }
}

Json answer_of(const DesignSpace& space, const DesignPoint& point) {
  Json all = Json::array();
  for (int i = 0; i < space.size(); ++i) {
    all.push_back({{"name", space[i].name},
                   {"value", in_unit_of(space[i], point.values[i])},
                   {"unit", space[i].unit}});
  }
  return all;
}

Json answer_of(const std::vector<EndingClaim>& claims) {
  const auto limit = [](const std::optional<double>& value) {
    return value ? json_of(*value) : Json(nullptr);
  };
  Json all = Json::array();
  for (const EndingClaim& claim : claims) {
    Json numbers = Json::array();
    for (const ClaimNumber& number : claim.numbers)
      numbers.push_back({{"name", number.name},
                         {"value", json_of(number.value)},
                         {"unit", number.unit},
                         {"at_most", limit(number.at_most)},
                         {"at_least", limit(number.at_least)}});
    all.push_back({{"statement", claim.statement},
                   {"variables", claim.variables},
                   {"test", claim.test},
                   {"numbers", numbers}});
  }
  return all;
}

Json answer_of(const DesignSpace& space, const std::vector<FoundBasin>& basins) {
  Json all = Json::array();
  for (const FoundBasin& basin : basins)
    all.push_back({{"target", json_of(basin.value)},
                   {"times_found", basin.hits},
                   {"searched_to_its_end", basin.has_ended},
                   {"variables", answer_of(space, basin.minimum)}});
  return all;
}

Json answer_of(const DesignSpace& space) {
  Json all = answer_of(space, space.initial());
  for (int i = 0; i < space.size(); ++i) {
    const DesignVariable& variable = space[i];
    Json& row = all[i];
    row.erase("value");
    row["initial"] = in_unit_of(variable, variable.initial);
    row["lower"] = in_unit_of(variable, variable.lower);
    row["upper"] = in_unit_of(variable, variable.upper);
    row["scale"] = variable.scale == Scale::linear ? "linear" : "logarithmic";
    row["paths"] = variable.paths;
  }
  return all;
}

Json answer_of(const correlation::Study& study, const correlation::Identifiability& result) {
  Json all = answer_of(study.space, result.best);
  for (int i = 0; i < study.space.size(); ++i) {
    const Interval interval = correlation::reported_interval(study, result, i);
    const auto end = [&](double u) -> Json {
      if (!(u >= 0.0 && u <= 1.0)) return nullptr;  // limited by the range, not by data
      DesignPoint point = result.point;
      auto at = study.space.to_unit(point);
      at[i] = u;
      return in_unit_of(study.space[i], study.space.from_unit(at).values[i]);
    };
    const bool is_kept =
        !study.free.empty() && !std::binary_search(study.free.begin(), study.free.end(), i);
    if (is_kept) {
      all[i]["interval"] = nullptr;
      all[i]["interval_from"] = "held in the last stage";
      continue;
    }
    all[i]["interval"] = {end(interval.lower), end(interval.upper)};
    all[i]["interval_from"] = correlation::interval_source(study, result, i);
    if (!result.refined_shift) continue;
    const double u = study.space.to_unit(result.point)[static_cast<std::size_t>(i)];
    all[i]["refined"] = end(u + (*result.refined_shift)[i]);
  }
  return all;
}

namespace {

Json answer_of_delay(const correlation::DelayBand& delay) {
  return {{"value", delay.value},
          {"lower", delay.lower},
          {"upper", delay.upper},
          {"at_end", delay.at_end},
          {"unit", "s"}};
}

}  // namespace

Json delays_of(const correlation::Study& study,
               const std::vector<correlation::ExperimentBand>& bands) {
  Json all = Json::array();
  for (std::size_t e = 0; e < bands.size(); ++e) {
    if (!bands[e].delay) continue;
    all.push_back(answer_of_delay(*bands[e].delay));
    all.back()["name"] = study.experiments[e].name;
  }
  return all;
}

Json answer_of(const correlation::Study& study, const correlation::UnreachedValues& row) {
  return {{"experiment", study.experiments[static_cast<std::size_t>(row.experiment)].name},
          {"values", row.values},
          {"beyond", row.beyond},
          {"between", row.between},
          {"farthest", row.farthest},
          {"deviations", row.farthest_by},
          {"moved_by", row.mover < 0 ? Json(nullptr) : Json(study.space[row.mover].name)},
          {"has_to_be", row.is_raised ? "larger" : "smaller"},
          {"noise_assumed", row.noise_assumed}};
}

Json answer_of(const correlation::Study& study,
               const std::vector<correlation::ExperimentBand>& bands) {
  Json all = Json::array();
  for (std::size_t e = 0; e < bands.size(); ++e) {
    const StudyExperiment& experiment = study.experiments[e];
    const correlation::ExperimentBand& band = bands[e];
    all.push_back({{"name", experiment.name},
                   {"fitted", experiment.fitted},
                   {"unit", experiment.observable->unit()},
                   {"rows", experiment.observable->rows()},
                   {"measured", json_of(experiment.observable->measured_values())},
                   {"computed", json_of(band.computed)},
                   {"lower", json_of(band.lower)},
                   {"upper", json_of(band.upper)},
                   {"noise", json_of(band.noise)},
                   {"inside", band.inside},
                   {"compared", band.compared},
                   {"remarks", band.remarks}});
    if (band.delay) all.back()["delay"] = answer_of_delay(*band.delay);
  }
  return all;
}

Json answer_of(const correlation::Study& study,
               const std::vector<correlation::MissedValue>& missed) {
  Json all = Json::array();
  for (const auto& one : missed) {
    Json row = {{"value", one.missed.name},
                {"error", one.missed.error},
                {"fitted", one.fitted},
                {"variable", nullptr},
                {"payer", nullptr},
                {"in_words", one.in_words(study.space)}};
    if (one.variable) row["variable"] = study.space[*one.variable].name;
    if (one.payer) row["payer"] = {{"value", one.payer->name}, {"error", one.payer->error}};
    all.push_back(std::move(row));
  }
  return all;
}

Json answer_of(const correlation::Study& study,
               const StudyExperiment& experiment,
               const Channels& trial) {
  const Comparison found = compare(experiment, study.experiments, trial);
  Json all = {{"name", experiment.name},
              {"kind", experiment.observable->kind()},
              {"fitted", experiment.fitted},
              {"measure", measure_in_words(experiment)},
              {"error", json_of(own_measure(experiment, found))},
              {"mean_error", json_of(found.mean_error)},
              {"largest_error", json_of(found.largest_error)}};
  auto [key, compared] = experiment.observable->answer(trial, found);
  all[key] = std::move(compared);
  return all;
}

void answer_counts(const correlation::TrialCounts& counts, bool targets_known) {
  answer()["trials"] = counts.trials;
  answer()["succeeded"] = targets_known ? Json(counts.succeeded()) : Json(nullptr);
  answer()["failed"] = targets_known ? Json(counts.failed) : Json(nullptr);
  answer()["foreign"] = counts.foreign;
}

}  // namespace latsch::cli
