// SPDX-License-Identifier: Apache-2.0
#include "cli/console/certainty_answers.h"

#include <cmath>
#include <nlohmann/json.hpp>

#include "base/units.h"
#include "correlation/observable/curve.h"

namespace latsch::cli {
namespace {

using correlation::Identifiability;
using correlation::json_of;
using correlation::NuisanceKind;
using correlation::Study;
using correlation::StudyExperiment;

/// Returns the value of a variable at u in the unit cube, in the unit of the study; null beyond its
/// bounds.
Json value_at(const DesignSpace& space, int variable, double u) {
  if (!(u >= 0.0 && u <= 1.0)) return nullptr;
  std::vector<double> all(static_cast<std::size_t>(space.size()), 0.5);
  const auto i = static_cast<std::size_t>(variable);
  all[i] = u;
  return json_of(Unit::of(space[variable].unit).from_si(space.from_unit(all).values[i]));
}

Json interval_at(const DesignSpace& space, int variable, const Interval& interval) {
  return {value_at(space, variable, interval.lower), value_at(space, variable, interval.upper)};
}

/// Returns the SI unit of a nuisance number.
std::string unit_of(const StudyExperiment& experiment, NuisanceKind kind) {
  const auto* curve = dynamic_cast<const correlation::Curve*>(experiment.observable.get());
  switch (kind) {
    case NuisanceKind::offset:
      return experiment.observable->unit();
    case NuisanceKind::gain:
      return "1";
    case NuisanceKind::delay:
      return "s";
    case NuisanceKind::x_offset:
      return curve ? curve->measured().x_unit : "m";
  }
  return "1";
}

}  // namespace

Json correlations_of(const Study& study, const Identifiability& result) {
  const Eigen::MatrixXd& correlation = result.identification.confidence().correlation;
  Json names = Json::array(), matrix = Json::array();
  for (int i = 0; i < study.space.size(); ++i) {
    names.push_back(study.space[i].name);
    Json row = Json::array();
    for (int j = 0; j < study.space.size(); ++j) row.push_back(json_of(correlation(i, j)));
    matrix.push_back(std::move(row));
  }
  return {{"variables", std::move(names)}, {"matrix", std::move(matrix)}};
}

Json directions_of(const Study& study, const Identifiability& result) {
  const Confidence& c = result.identification.confidence();
  Json all = Json::array();
  for (Eigen::Index k = 0; k < c.directions.cols(); ++k) {
    Json components = Json::object();
    for (int i = 0; i < study.space.size(); ++i)
      components[study.space[i].name] = json_of(c.directions(i, k));
    all.push_back({{"singular_value", json_of(c.singular_values[k])},
                   {"deviation", json_of(c.deviation(static_cast<int>(k)))},
                   {"direction", std::move(components)}});
  }
  return all;
}

Json profiles_of(const Study& study, const Identifiability& result) {
  Json all = Json::array();
  for (const TargetProfile& profile : result.identification.profiles()) {
    const auto value = [&](const ProfilePoint& at) {
      return value_at(study.space, profile.variable, at.u[profile.variable]);
    };
    Json points = Json::array(), minima = Json::array();
    for (const ProfilePoint& at : profile.points)
      points.push_back({{"value", value(at)},
                        {"rise", json_of((at.S - profile.least) / profile.threshold)},
                        {"converged", at.converged}});
    for (const int place : profile.other_minima)
      minima.push_back(value(profile.points[static_cast<std::size_t>(place)]));
    all.push_back({{"variable", study.space[profile.variable].name},
                   {"unit", study.space[profile.variable].unit},
                   {"verdict", name(profile.verdict)},
                   {"in_words", in_words(profile)},
                   {"interval", interval_at(study.space, profile.variable, profile.interval)},
                   {"points", std::move(points)},
                   {"other_minima", std::move(minima)}});
  }
  return all;
}

Json left_out_of(const Study& study, const Identifiability& result) {
  Json all = Json::array();
  if (!result.cross_validation) return all;
  for (const LeftOut& fold : result.cross_validation->left_out())
    all.push_back({{"experiment", study.experiments[static_cast<std::size_t>(fold.group)].name},
                   {"fitted", json_of(fold.fitted)},
                   {"predicted", json_of(fold.predicted)}});
  return all;
}

Json gains_of(const Study& study, const std::vector<correlation::MeasurementGain>& gains) {
  Json all = Json::array();
  for (const correlation::MeasurementGain& gain : gains)
    all.push_back({{"measurement", gain.measurement},
                   {"shrinkage", json_of(gain.shrinkage)},
                   {"helps", study.space[gain.helps].name},
                   {"before", json_of(gain.before)},
                   {"after", json_of(gain.after)}});
  return all;
}

void answer_certainty(const Study& study, const Identifiability& result) {
  answer()["correlations"] = correlations_of(study, result);
  answer()["directions"] = directions_of(study, result);
  if (!result.identification.profiles().empty()) answer()["profiles"] = profiles_of(study, result);
  if (result.cross_validation) answer()["left_out"] = left_out_of(study, result);
}

void answer_nuisance(const Study& study, const std::vector<correlation::ExperimentBand>& bands) {
  Json numbers = Json::array(), costs = Json::array(), remarks = Json::array();
  for (std::size_t e = 0; e < bands.size(); ++e) {
    for (const correlation::NuisanceRow& row : bands[e].nuisance) {
      const bool is_free = row.number.is_free(), is_shared = row.number.is_shared();
      numbers.push_back({{"experiment", study.experiments[e].name},
                         {"number", correlation::name_of(row.number.kind)},
                         {"shared", is_shared ? Json(row.number.shared) : Json(nullptr)},
                         {"value", row.value},
                         {"deviation", json_of(row.deviation)},
                         {"prior", is_free ? Json(nullptr) : Json(row.number.prior)},
                         {"unit", unit_of(study.experiments[e], row.number.kind)},
                         {"from_prior", is_free ? Json(nullptr) : Json(row.from_prior())},
                         {"at_end", row.at_end},
                         {"is_determined", row.is_determined && !row.is_open()},
                         {"in_words", row.in_words()}});
    }
    for (const correlation::NuisanceCost& cost : bands[e].nuisance_costs)
      costs.push_back({{"variable", study.space[cost.variable].name},
                       {"unit", study.space[cost.variable].unit},
                       {"solved", interval_at(study.space, cost.variable, cost.with)},
                       {"known", interval_at(study.space, cost.variable, cost.without)}});
    for (const std::string& remark : bands[e].nuisance_remarks) remarks.push_back(remark);
  }
  answer()["nuisance"] = std::move(numbers);
  if (!costs.empty()) answer()["nuisance_costs"] = std::move(costs);
  if (!remarks.empty()) answer()["nuisance_remarks"] = std::move(remarks);
}

}  // namespace latsch::cli
