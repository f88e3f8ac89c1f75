// SPDX-License-Identifier: Apache-2.0
#include <algorithm>
#include <numeric>

#include "base/error.h"
#include "correlation/target/compared_trial.h"
#include "studio/views/json_values.h"
#include "studio/views/trial_hints.h"
#include "studio/views/views.h"
#include "studio/views/weights.h"

namespace latsch::studio {
namespace {

using Sight = ShelvedStudy::Sight;
using Weighting = correlation::PartedTarget::Weighting;

constexpr long kMostRows = 500;
constexpr long kMostPoints = 20'000;

const TrialTable& table_of(const ShelvedStudy& study, const Sight& sight) {
  if (!sight.table) throw InputError(study.id() + " cannot be read: " + sight.error);
  return *sight.table;
}

Json values_of(const correlation::Study& study, const DesignPoint& point) {
  Json values = Json::array();
  for (int i = 0; i < study.space.size(); ++i)
    values.push_back(in_unit(point.values[static_cast<std::size_t>(i)], study.space[i].unit));
  return values;
}

Json row_of(const Sight& sight, std::size_t place, const Weighting& weighting) {
  const TableRow& row = sight.table->rows()[place];
  const bool failed = !row.parts;
  return {{"trial", place + 1},
          {"target", failed ? Json(nullptr) : finite(weighting.target(*row.parts))},
          {"violation", failed ? Json(nullptr) : finite(row.parts->violation)},
          {"counts", sight.table->counts(place)},
          {"foreign", sight.table->is_foreign(place)},
          {"values", values_of(*sight.study, row.point)},
          {"reason",
           failed ? sight.table->reasons()[static_cast<std::size_t>(row.reason)] : std::string()},
          {"cause", failed ? words_of(row.cause) : std::string()},
          {"seconds", finite(row.seconds)}};
}

/// Indices of the trials that represent several successive trials: least target, greatest target,
/// first failure.
struct Extremes {
  std::optional<std::size_t> least, greatest, failed;
};

}  // namespace

Json convergence_view(const ShelvedStudy& study,
                      const TrialRange& stretch,
                      const std::string& weights) {
  return study.look([&](const Sight& sight) {
    const TrialTable& table = table_of(study, sight);
    const Weighting weighting = weighting_of(weights, table.target());
    const long total = static_cast<long>(table.rows().size());
    const long from = std::clamp(stretch.from, 1L, std::max(1L, total));
    const long to = stretch.to <= 0 ? total : std::clamp(stretch.to, from, std::max(from, total));
    const long most = std::clamp(stretch.most, kFewestPoints, kMostPoints);
    const long count = std::max(0L, std::min(to, total) - from + 1);
    // number of successive trials that are drawn as three points
    const long width = std::max(1L, (3 * count + most - 1) / most);

    std::vector<double> targets(static_cast<std::size_t>(total));
    std::vector<double> best(static_cast<std::size_t>(total));
    double least = std::numeric_limits<double>::infinity();
    for (std::size_t k = 0; k < targets.size(); ++k) {
      const TableRow& row = table.rows()[k];
      targets[k] = row.parts ? weighting.target(*row.parts) : std::nan("");
      if (row.parts && row.parts->violation <= kFulfilled && table.counts(k) &&
          table.can_be_best(k))
        least = std::min(least, targets[k]);
      best[k] = least;
    }
    Json view{{"total", total}, {"from", from}, {"to", to}, {"is_decimated", width > 1}};
    Json trials = Json::array(), values = Json::array(), bests = Json::array(),
         failed = Json::array();
    const auto show = [&](std::size_t k) {
      trials.push_back(k + 1);
      values.push_back(finite(targets[k]));
      bests.push_back(finite(best[k]));
    };
    for (long begin = from - 1; begin < from - 1 + count; begin += width) {
      Extremes found;
      const long end = std::min(begin + width, from - 1 + count);
      for (long place = begin; place < end; ++place) {
        const auto k = static_cast<std::size_t>(place);
        if (!table.rows()[k].parts) {
          if (!found.failed) found.failed = k;
        } else {
          if (!found.least || targets[k] < targets[*found.least]) found.least = k;
          if (!found.greatest || targets[k] > targets[*found.greatest]) found.greatest = k;
        }
      }
      if (found.failed) failed.push_back(*found.failed + 1);
      if (!found.least) continue;
      show(std::min(*found.least, *found.greatest));
      if (*found.least != *found.greatest) show(std::max(*found.least, *found.greatest));
    }
    view["trial"] = std::move(trials);
    view["target"] = std::move(values);
    view["best"] = std::move(bests);
    view["failed"] = std::move(failed);
    return view;
  });
}

Json trials_view(const ShelvedStudy& study, const TrialsPage& page, const std::string& weights) {
  return study.look([&](const Sight& sight) {
    const TrialTable& table = table_of(study, sight);
    const Weighting weighting = weighting_of(weights, table.target());
    const long total = static_cast<long>(table.rows().size());
    std::vector<std::size_t> order(static_cast<std::size_t>(total));
    std::iota(order.begin(), order.end(), 0);
    if (page.by_target) {
      std::vector<std::pair<double, double>> rank(order.size());  // failed trials come last
      for (std::size_t k = 0; k < rank.size(); ++k) {
        const auto& parts = table.rows()[k].parts;
        constexpr double kLast = std::numeric_limits<double>::infinity();
        rank[k] = parts
                      ? std::pair(std::max(parts->violation, kFulfilled), weighting.target(*parts))
                      : std::pair(kLast, kLast);
      }
      std::stable_sort(
          order.begin(), order.end(), [&](auto a, auto b) { return rank[a] < rank[b]; });
    }
    const long from = std::max(1L, page.from);
    const long count = std::clamp(page.count, 0L, kMostRows);
    Json rows = Json::array();
    for (long k = from - 1; k < std::min(total, from - 1 + count); ++k)
      rows.push_back(row_of(sight, order[static_cast<std::size_t>(k)], weighting));
    return Json{{"total", total}, {"rows", std::move(rows)}};
  });
}

Json trial_view(const ShelvedStudy& study, long trial) {
  return study.look([&](const Sight& sight) {
    const TrialTable& table = table_of(study, sight);
    const auto count = static_cast<long>(table.rows().size());
    if (trial < 1 || trial > count)
      throw InputError("there is no trial " + std::to_string(trial) + "; they are numbered 1 to " +
                       std::to_string(count));
    const auto place = static_cast<std::size_t>(trial - 1);
    const auto& target = table.target();
    const Weighting weighting = target.weighting(target.weights());
    Json view = row_of(sight, place, weighting);
    const TableRow& row = table.rows()[place];
    view["hint"] = row.parts ? std::string() : hint_for(row.cause);
    view["experiments"] = Json::array();
    std::size_t e = 0;
    for (const auto& experiment : sight.study->experiments) {
      if (!experiment.fitted || !row.parts) continue;
      const double whole = weighting.target(*row.parts);
      view["experiments"].push_back(
          {{"name", experiment.name},
           {"fitted", true},
           {"weight", experiment.objective.weight},
           {"value", finite(row.parts->values[e])},
           {"share", whole > 0.0 ? finite(weighting.share(*row.parts, e) / whole) : Json(nullptr)},
           {"measure", measure_in_words(experiment)},
           {"error", finite(row.parts->errors[e])},
           {"largest_error", finite(row.parts->largest_errors[e])}});
      ++e;
    }
    return view;
  });
}

}  // namespace latsch::studio
