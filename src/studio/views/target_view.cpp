// SPDX-License-Identifier: Apache-2.0
// The target function as the trials show it: surfaces over a grid, slices through its best point,
// minima, and a scatter of trials if there is no grid.
#include <algorithm>
#include <map>

#include "base/error.h"
#include "correlation/doe/doe_surface.h"
#include "correlation/study_report/report_identifiability.h"
#include "studio/views/json_values.h"
#include "studio/views/views.h"
#include "studio/views/weights.h"

namespace latsch::studio {
namespace {

using correlation::RatedTrial;
using correlation::Study;

constexpr std::size_t kMostScattered = 2000;

Json axis(const Study& study, const std::string& name, const std::vector<double>& levels) {
  for (const DesignVariable& v : study.space.variables()) {
    if (v.name == name)
      return {{"name", name},
              {"unit", v.unit},
              {"scale", v.scale == Scale::logarithmic ? "logarithmic" : "linear"},
              {"levels", in_unit(levels, v.unit)}};
  }
  return {{"name", name}, {"unit", "1"}, {"scale", "linear"}, {"levels", finite(levels)}};
}

Json point_on(const report::Surface& surface, const std::optional<Eigen::Vector2d>& point) {
  if (!point) return nullptr;
  return {in_unit((*point)[0], surface.x_unit), in_unit((*point)[1], surface.y_unit)};
}

Json surface_of(const Study& study, const report::Surface& surface) {
  Json rows = Json::array();
  for (Eigen::Index i = 0; i < surface.target.rows(); ++i) {
    Json row = Json::array();
    for (Eigen::Index j = 0; j < surface.target.cols(); ++j)
      row.push_back(finite(surface.target(i, j)));
    rows.push_back(std::move(row));
  }
  return {{"x", axis(study, surface.x_name, surface.x)},
          {"y", axis(study, surface.y_name, surface.y)},
          {"target", std::move(rows)},
          {"held", surface.held},
          {"found", point_on(surface, surface.found)},
          {"initial", point_on(surface, surface.initial)}};
}

/// Returns the slices: trials that differ from the best one in a single variable.
Json slices(const Study& study, const std::vector<RatedTrial>& trials, const DesignPoint& best) {
  Json list = Json::array();
  for (int i = 0; i < study.space.size(); ++i) {
    const auto v = static_cast<std::size_t>(i);
    std::map<double, double> along;
    for (const RatedTrial& trial : trials) {
      bool is_on_line = true;
      for (std::size_t k = 0; k < best.values.size() && is_on_line; ++k)
        is_on_line = k == v || trial.point.values[k] == best.values[k];
      if (is_on_line) along[trial.point.values[v]] = trial.target;
    }
    constexpr std::size_t kLeast = 3;
    if (along.size() < kLeast) continue;
    std::vector<double> x, target;
    for (const auto& [at, value] : along) {
      x.push_back(at);
      target.push_back(value);
    }
    const DesignVariable& variable = study.space[i];
    list.push_back({{"variable", variable.name},
                    {"unit", variable.unit},
                    {"scale", variable.scale == Scale::logarithmic ? "logarithmic" : "linear"},
                    {"x", in_unit(x, variable.unit)},
                    {"target", finite(target)},
                    {"found", in_unit(best.values[v], variable.unit)}});
  }
  return list;
}

Json minima(const std::optional<report::Basins>& basins) {
  if (!basins) return nullptr;
  Json rows = Json::array();
  for (const auto& row : basins->rows)
    rows.push_back(
        {{"target", finite(row.target)}, {"points", row.points}, {"values", row.values}});
  return {{"design", basins->design},
          {"variables", basins->variables},
          {"count", basins->count},
          {"rows", std::move(rows)},
          {"doubt", basins->doubt}};
}

/// Returns the trials with the lowest targets, and a sample of the others.
Json scatter(const Study& study,
             const std::vector<RatedTrial>& trials,
             const std::vector<long>& numbers) {
  std::vector<std::size_t> shown(trials.size());
  for (std::size_t k = 0; k < shown.size(); ++k) shown[k] = k;
  if (shown.size() > kMostScattered) {
    std::nth_element(
        shown.begin(), shown.begin() + kMostScattered / 2, shown.end(), [&](auto a, auto b) {
          return trials[a].target < trials[b].target;
        });
    const std::size_t step = (shown.size() - kMostScattered / 2) / (kMostScattered / 2) + 1;
    std::vector<std::size_t> few(shown.begin(), shown.begin() + kMostScattered / 2);
    for (std::size_t k = kMostScattered / 2; k < shown.size(); k += step) few.push_back(shown[k]);
    shown = std::move(few);
    std::sort(shown.begin(), shown.end());
  }
  Json trial = Json::array(), target = Json::array(), values = Json::array();
  for (const std::size_t k : shown) {
    trial.push_back(numbers[k]);
    target.push_back(finite(trials[k].target));
  }
  for (int i = 0; i < study.space.size(); ++i) {
    std::vector<double> column;
    for (const std::size_t k : shown)
      column.push_back(trials[k].point.values[static_cast<std::size_t>(i)]);
    values.push_back(in_unit(column, study.space[i].unit));
  }
  return {{"trial", trial}, {"target", target}, {"values", values}};
}

Json effects(const std::vector<report::EffectRow>& rows) {
  Json list = Json::array();
  for (const auto& row : rows)
    list.push_back({{"variable", row.variable},
                    {"mu_star", finite(row.mu_star)},
                    {"mu", finite(row.mu)},
                    {"sigma", finite(row.sigma)}});
  return list;
}

}  // namespace

Json target_view(const ShelvedStudy& shelved, const std::string& weights) {
  std::shared_ptr<const Study> study;
  std::vector<RatedTrial> trials;
  std::vector<long> numbers;
  std::optional<DesignPoint> best;
  shelved.look([&](const ShelvedStudy::Sight& sight) {
    if (!sight.study) throw InputError(shelved.id() + " cannot be read: " + sight.error);
    study = sight.study;
    const auto weighting = weighting_of(weights, sight.table->target());
    const auto& rows = sight.table->rows();
    for (std::size_t k = 0; k < rows.size(); ++k) {
      if (!rows[k].parts || !sight.table->counts(k)) continue;
      trials.push_back({rows[k].point, weighting.target(*rows[k].parts), rows[k].parts->violation});
      numbers.push_back(static_cast<long>(k + 1));
    }
    if (const auto place = sight.table->best(weighting)) best = rows[*place].point;
  });
  Json view{{"surfaces", Json::array()},
            {"slices", Json::array()},
            {"minima", nullptr},
            {"effects", Json::array()},
            {"variables", Json::array()}};
  for (const DesignVariable& v : study->space.variables())
    view["variables"].push_back(
        {{"name", v.name},
         {"unit", v.unit},
         {"scale", v.scale == Scale::logarithmic ? "logarithmic" : "linear"}});
  view["scatter"] = scatter(*study, trials, numbers);
  if (!best) return view;
  for (const auto& surface : correlation::doe_surfaces(*study, trials, *best))
    view["surfaces"].push_back(surface_of(*study, surface));
  view["slices"] = slices(*study, trials, *best);
  view["minima"] = minima(correlation::basins_of(*study, trials));
  view["effects"] = effects(correlation::effects_of(*study, trials));
  return view;
}

}  // namespace latsch::studio
