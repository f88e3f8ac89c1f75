// SPDX-License-Identifier: Apache-2.0
// The table of single values, as in the compliance tool of the thesis: weight, measured value,
// initial value, optimized value and error, one row for each number. A whole curve has one row, for
// its error in the measure of its experiment.
#include <fmt/format.h>

#include <cmath>

#include "correlation/analysis/identifiability.h"
#include "studio/views/json_values.h"
#include "studio/views/kept_identifiability.h"
#include "studio/views/recorded_trial.h"
#include "studio/views/views.h"
#include "studio/views/weights.h"

namespace latsch::studio {
namespace {

using correlation::Study;

// share of the largest weight below which a value counts as hardly weighted
constexpr double kNextToNoWeight = 1e-6;
// share of the range: a variable nearer to a bound counts as at the bound
constexpr double kAtBound = 1e-3;
constexpr double kMissed = 0.1;  // relative error from which the row has a remark

std::string weight_flag(double weight, double largest) {
  return weight < kNextToNoWeight * largest ? "weight about zero: it does not count" : "";
}

struct Row {
  std::string name = {}, experiment = {}, unit = {};
  double weight = 1.0;
  Json target = nullptr, initial = nullptr, optimized = nullptr, error = nullptr;
  bool fitted = true;
  std::string flag = {};
};

Json json_of(const Row& row) {
  return {{"name", row.name},
          {"experiment", row.experiment},
          {"unit", row.unit},
          {"weight", row.weight},
          {"target", row.target},
          {"initial", row.initial},
          {"optimized", row.optimized},
          {"error", row.error},
          {"fitted", row.fitted},
          {"flag", row.flag}};
}

std::string error_flag(double error) {
  return std::abs(error) > kMissed ? fmt::format("missed by {:.0f} %", 100.0 * std::abs(error))
                                   : "";
}

/// Returns the row of the error of a whole curve or set of modes, in the measure of its experiment;
/// the measured value of the error is 0.
Row error_row(const report::ExperimentRow& of) {
  Row row{of.measure + " error", of.name, "%", 0.0};
  row.fitted = of.fitted;
  row.target = 0.0;
  row.optimized = finite(100.0 * of.error);
  row.error = finite(of.error);
  row.flag = error_flag(of.error);
  if (of.initial_error) row.initial = finite(100.0 * *of.initial_error);
  return row;
}

Row mode_row(const report::ModalComparison& modes,
             const report::ComparedModes& pair,
             double weight) {
  Row row{pair.label, modes.experiment, "Hz", weight};
  const double error = (pair.simulated - pair.measured) / pair.measured;
  row.target = finite(pair.measured);
  row.initial = finite(pair.initial);
  row.optimized = finite(pair.simulated);
  row.error = finite(error);
  row.fitted = modes.fitted;
  row.flag = error_flag(error);
  return row;
}

Row value_row(const report::MeasuredValue& value) {
  Row row{
      value.compared.empty() ? value.name : value.compared, value.name, value.unit, value.weight};
  row.target = in_unit(value.measured, value.unit);
  row.initial = value.initial ? in_unit(*value.initial, value.unit) : Json(nullptr);
  row.optimized = in_unit(value.found, value.unit);
  row.fitted = value.fitted;
  if (value.measured == 0.0) return row;
  const double error = (value.found - value.measured) / std::abs(value.measured);
  row.error = finite(error);
  row.flag = error_flag(error);
  return row;
}

std::string bound_flag(const DesignSpace& space, const DesignPoint& point, int i) {
  const auto place = space.place(point);
  if (!place) return "";
  const double u = (*place)[static_cast<std::size_t>(i)];
  if (u < kAtBound) return "at its lower bound";
  if (u > 1.0 - kAtBound) return "at its upper bound";
  return "";
}

Json variable_rows(const ShelvedStudy& shelved, const RecordedTrial& recorded) {
  const Study& study = *recorded.study;
  const KeptIdentifiability kept = kept_identifiability(shelved);
  Json rows = Json::array();
  for (int i = 0; i < study.space.size(); ++i) {
    const DesignVariable& v = study.space[i];
    std::string interval, source, flag = bound_flag(study.space, recorded.point, i);
    if (kept.what && kept.what->best == recorded.point) {
      interval = correlation::interval_text(study, *kept.what, i);
      source = correlation::interval_source(study, *kept.what, i);
      if (source == "bounds") flag = "its interval comes from the bounds alone, not from the data";
    }
    rows.push_back(
        {{"name", v.name},
         {"unit", v.unit},
         {"initial", in_unit(v.initial, v.unit)},
         {"optimized", in_unit(recorded.point.values[static_cast<std::size_t>(i)], v.unit)},
         {"lower", in_unit(v.lower, v.unit)},
         {"upper", in_unit(v.upper, v.unit)},
         {"interval", interval},
         {"interval_from", source},
         {"flag", flag}});
  }
  return rows;
}

}  // namespace

Json kpi_view(const ShelvedStudy& shelved, const std::string& weights) {
  std::map<std::string, double> weight_of;
  double largest = 0.0;
  Json targets{{"initial", nullptr}, {"optimized", nullptr}};
  const std::string trial = shelved.look([&](const ShelvedStudy::Sight& sight) -> std::string {
    if (!sight.table) return "best";
    const auto& target = sight.table->target();
    const auto values = weights_of(weights, target);
    const auto weighting = target.weighting(values);
    const auto names = target.experiments();
    for (std::size_t e = 0; e < names.size(); ++e) {
      weight_of[names[e]] = values[e];
      largest = std::max(largest, values[e]);
    }
    const auto target_at = [&](std::size_t place) {
      return finite(weighting.target(*sight.table->rows()[place].parts));
    };
    if (const auto initial = sight.table->initial()) targets["initial"] = target_at(*initial);
    const auto best = sight.table->best(weighting);
    if (!best) return "best";
    targets["optimized"] = target_at(*best);
    return std::to_string(*best + 1);
  });
  const RecordedTrial recorded = recorded_trial(shelved, trial);
  const Drawn drawn = draw(recorded);
  Json view{{"trial", recorded.trial}, {"target", targets}, {"rows", Json::array()}};
  const auto add = [&](Row row) {
    if (const auto found = weight_of.find(row.experiment); found != weight_of.end())
      row.weight = found->second;
    if (row.fitted && row.flag.empty()) row.flag = weight_flag(row.weight, largest);
    view["rows"].push_back(json_of(row));
  };
  const auto add_error = [&](const std::string& experiment) {
    for (const report::ExperimentRow& row : drawn.page.experiments)
      if (row.name == experiment) return add(error_row(row));
  };
  for (const auto& curve : drawn.page.forces) add_error(curve.experiment);
  for (const auto& curve : drawn.page.curves) add_error(curve.experiment);
  for (const auto& modes : drawn.page.modes)
    for (const auto& pair : modes.pairs) add(mode_row(modes, pair, 0.0));
  for (const auto& value : drawn.page.values) add(value_row(value));
  view["variables"] = variable_rows(shelved, recorded);
  return view;
}

}  // namespace latsch::studio
