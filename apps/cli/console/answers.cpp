// SPDX-License-Identifier: Apache-2.0
#include "cli/console/answers.h"

#include <cmath>
#include <nlohmann/json.hpp>

#include "base/file.h"
#include "base/units.h"
#include "experiment/rigs/mode_record.h"
#include "formats/tables/csv_table.h"

namespace latsch::cli {
namespace {

using correlation::Comparison;
using correlation::StudyExperiment;

/// null where it is not finite: JSON has no other number for that.
Json number(double value) { return std::isfinite(value) ? Json(value) : Json(nullptr); }

Json numbers(const std::vector<double>& values) {
  Json list = Json::array();
  for (const double value : values) list.push_back(number(value));
  return list;
}

Json in_unit_of(const DesignVariable& variable, double value) {
  return number(Unit::of(variable.unit).from_si(value));
}

Json forces(const StudyExperiment& experiment, const Channels& channels, const Comparison& found) {
  return {{"deflection_m", numbers(channels["deflection"])},
          {"measured_N", numbers(experiment.forces)},
          {"simulated_N", numbers(channels["force"])},
          {"error", numbers(found.errors)}};
}

Json modes(const StudyExperiment& experiment, const Channels& channels, const Comparison& found) {
  const auto simulated = experiment::mode_records(channels);
  Json rows = Json::array();
  for (const auto& pair : found.pairing.pairs) {
    rows.push_back({{"measured_Hz", number(experiment.modes[pair.measured].frequency)},
                    {"simulated_Hz", number(simulated[pair.simulated].frequency)},
                    {"error", number(found.errors[pair.measured])},
                    {"likeness", number(pair.likeness)},
                    {"measured_as", experiment.modes[pair.measured].label()},
                    {"simulated_as", simulated[pair.simulated].label()}});
  }
  for (const int i : found.pairing.missing) {
    rows.push_back({{"measured_Hz", number(experiment.modes[i].frequency)},
                    {"simulated_Hz", nullptr},
                    {"error", number(found.errors[i])},
                    {"measured_as", experiment.modes[i].label()}});
  }
  return rows;
}

Json curve(const StudyExperiment& experiment, const Channels& channels, const Comparison& found) {
  const correlation::CurveExperiment& c = *experiment.curve;
  const auto simulated = simulated_curve(c, channels);
  return {{"at", numbers(c.x_compared)},
          {"at_unit", c.x_compared.empty() ? "" : c.x_compared_unit},
          {"measured", numbers(c.y_compared)},
          {"simulated", simulated ? numbers(*simulated) : Json(nullptr)},
          {"unit", c.y_compared_unit},
          {"error", numbers(found.errors)}};
}

}  // namespace

Json answer_of(const Channels& channels) {
  Json all = Json::array();
  for (const Channel& channel : channels.all()) {
    all.push_back(
        {{"name", channel.name}, {"unit", channel.unit}, {"values", numbers(channel.values)}});
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
      if (!(u >= 0.0 && u <= 1.0)) return nullptr;  // beyond the bounds: they hold it, not the data
      DesignPoint point = result.point;
      auto at = study.space.to_unit(point);
      at[i] = u;
      return in_unit_of(study.space[i], study.space.from_unit(at).values[i]);
    };
    all[i]["interval"] = {end(interval.lower), end(interval.upper)};
  }
  return all;
}

const char* kind_of(const StudyExperiment& experiment) {
  if (experiment.curve) return "curve";
  return experiment.modal() ? "modes" : "load_deflection";
}

Json answer_of(const StudyExperiment& experiment, const Channels& channels) {
  const Comparison found = compare(experiment, channels);
  Json all = {{"name", experiment.name},
              {"kind", kind_of(experiment)},
              {"fitted", experiment.fitted},
              {"mean_error", number(found.mean_error)},
              {"largest_error", number(found.largest_error)}};
  if (experiment.curve) {
    all["curve"] = curve(experiment, channels, found);
  } else if (experiment.modal()) {
    all["modes"] = modes(experiment, channels, found);
  } else {
    all["forces"] = forces(experiment, channels, found);
  }
  return all;
}

}  // namespace latsch::cli
