// SPDX-License-Identifier: Apache-2.0
#include "studio/views/posterior_view.h"

#include <algorithm>
#include <cmath>
#include <numeric>
#include <utility>

#include "correlation/posterior/compared_bands.h"
#include "studio/views/json_values.h"

namespace latsch::studio {
namespace {

using Json = nlohmann::ordered_json;

constexpr std::size_t kValuesShown = 600;  // values of an experiment that the page receives
constexpr Eigen::Index kDrawsShown = 400;  // draws of a variable that the page receives
/// Number of variables with draws: those that are least like their linear intervals.
constexpr std::size_t kVariablesDrawn = 12;

/// Returns, for each sampled variable, true if it is among those that differ most from their linear
/// intervals.
std::vector<bool> drawn_variables(const correlation::Posterior& posterior) {
  std::vector<std::size_t> order(posterior.axes.size());
  std::iota(order.begin(), order.end(), 0);
  std::stable_sort(order.begin(), order.end(), [&](std::size_t a, std::size_t b) {
    return posterior.shapes[a].distance > posterior.shapes[b].distance;
  });
  std::vector<bool> drawn(order.size(), false);
  for (std::size_t k = 0; k < std::min(order.size(), kVariablesDrawn); ++k) drawn[order[k]] = true;
  return drawn;
}

Json draws_of(const correlation::Study& study,
              const correlation::Posterior& posterior,
              std::size_t axis) {
  const Eigen::Index count = std::min(posterior.samples.size(), kDrawsShown);
  std::vector<double> values;
  for (Eigen::Index k = 0; k < count; ++k) {
    const Eigen::Index sample = k * posterior.samples.size() / count;
    values.push_back(posterior.value_at(
        study.space, axis, posterior.samples.u(static_cast<Eigen::Index>(axis), sample)));
  }
  return in_unit(values, study.space[posterior.axes[axis]].unit);
}

Json variable_of(const correlation::Study& study,
                 const correlation::Posterior& posterior,
                 std::size_t axis,
                 bool is_drawn) {
  const PosteriorShape& shape = posterior.shapes[axis];
  const Interval& linear = posterior.linear[axis];
  const DesignVariable& v = study.space[posterior.axes[axis]];
  const ChainDiagnostics& d = posterior.samples.diagnostics[axis];
  const auto shown = [&](double u) -> Json {
    if (!std::isfinite(u) || u < 0.0 || u > 1.0) return nullptr;
    return in_unit(posterior.value_at(study.space, axis, u), v.unit);
  };
  const auto found = posterior.center.values[static_cast<std::size_t>(posterior.axes[axis])];
  return {{"name", v.name},
          {"unit", v.unit},
          {"scale", v.scale == Scale::logarithmic ? "logarithmic" : "linear"},
          {"found", in_unit(found, v.unit)},
          {"median", shown(shape.median)},
          {"interval", {shown(shape.lower), shown(shape.upper)}},
          {"linear", {shown(linear.lower), shown(linear.upper)}},
          {"distance", finite(shape.distance)},
          {"shape",
           posterior.is_mixed() ? in_words(shape, correlation::axis_names(study, posterior))
                                : std::string("not mixed")},
          {"rhat", finite(d.rhat)},
          {"effective", finite(std::min(d.bulk, d.tail))},
          {"draws", is_drawn ? draws_of(study, posterior, axis) : Json::array()}};
}

/// Returns at most kValuesShown of the values, at even distance.
template <class Values>
Values thinned_values(const Values& values) {
  if (values.size() <= kValuesShown) return values;
  Values some;
  for (std::size_t k = 0; k < kValuesShown; ++k)
    some.push_back(values[k * values.size() / kValuesShown]);
  return some;
}

/// Returns the bands as differences from the computed value at the fit, or from the median of the
/// samples where that value is not known: a band is much narrower than its curve.
Json bands_of(const correlation::Study& study,
              const correlation::Posterior& posterior,
              const std::vector<correlation::ExperimentBand>& linear) {
  Json all = Json::array();
  for (const correlation::ComparedBands& band :
       correlation::compared_bands(study, posterior, linear)) {
    const std::string& name = study.experiments[static_cast<std::size_t>(band.experiment)].name;
    const bool is_known = std::isfinite(band.computed.front());
    const std::vector<double>& center = is_known ? band.computed : band.median;
    const auto shown = [&center](std::vector<double> values) {
      for (std::size_t k = 0; k < values.size(); ++k) values[k] -= center[k];
      return finite(thinned_values(values));
    };
    all.push_back({{"experiment", name},
                   {"title", name + (is_known ? " less computed" : " less median")},
                   {"unit", band.unit},
                   {"x_name", band.x_name},
                   {"x_unit", band.x_unit},
                   {"x", finite(thinned_values(band.x))},
                   {"names", thinned_values(band.names)},
                   {"center", finite(thinned_values(center))},
                   {"measured", shown(band.measured)},
                   {"linear_lower", shown(band.linear_lower)},
                   {"linear_upper", shown(band.linear_upper)},
                   {"lower", shown(band.lower)},
                   {"upper", shown(band.upper)},
                   {"values", band.names.size()}});
  }
  return all;
}

/// Returns the sentences about the density and, where the samples are those of the model, the
/// predictive check of every experiment.
std::vector<std::string> remarks_of(const correlation::Study& study,
                                    const correlation::Posterior& posterior) {
  std::vector<std::string> remarks = posterior.remarks;
  if (!posterior.stands_for_model()) return remarks;
  for (const correlation::PredictiveCheck& check : posterior.checks)
    remarks.push_back(study.experiments[static_cast<std::size_t>(check.experiment)].name + ": " +
                      check.in_words() + ".");
  return remarks;
}

}  // namespace

nlohmann::ordered_json posterior_of(const correlation::Study& study,
                                    const Journal& journal,
                                    const std::vector<correlation::ExperimentBand>& linear) {
  const auto posterior = correlation::recorded_posterior(study, journal);
  if (!posterior) return nullptr;
  const bool is_of_model = posterior->stands_for_model();
  const std::vector<bool> drawn = drawn_variables(*posterior);
  Json variables = Json::array();
  for (std::size_t a = 0; a < posterior->axes.size(); ++a)
    variables.push_back(variable_of(study, *posterior, a, drawn[a]));
  return {
      {"verdict",
       posterior->method == correlation::PosteriorMethod::surrogate ? name(posterior->check.verdict)
                                                                    : "model"},
      {"mixed", posterior->is_mixed()},
      {"words", correlation::verdict_text(*posterior)},
      {"remarks", remarks_of(study, *posterior)},
      {"samples", posterior->samples.size()},
      {"trials", posterior->trials},
      {"failed", posterior->failed},
      {"variables", std::move(variables)},
      {"bands", is_of_model ? bands_of(study, *posterior, linear) : Json::array()}};
}

}  // namespace latsch::studio
