// SPDX-License-Identifier: Apache-2.0
#include <utility>

#include "correlation/analysis/prediction_bands.h"
#include "correlation/study_report/report_identifiability.h"
#include "studio/views/json_values.h"
#include "studio/views/kept_answers.h"
#include "studio/views/kept_identifiability.h"
#include "studio/views/posterior_view.h"
#include "studio/views/views.h"

namespace latsch::studio {
namespace {

constexpr std::size_t kPagesKept = 8;

Json square(const Eigen::MatrixXd& matrix) {
  Json rows = Json::array();
  for (Eigen::Index i = 0; i < matrix.rows(); ++i) {
    Json row = Json::array();
    for (Eigen::Index j = 0; j < matrix.cols(); ++j) row.push_back(finite(matrix(i, j)));
    rows.push_back(std::move(row));
  }
  return rows;
}

Json profile_of(const report::ProfileCurve& profile) {
  return {{"variable", profile.variable},
          {"unit", profile.unit},
          {"scale", profile.logarithmic ? "logarithmic" : "linear"},
          {"x", in_unit(profile.x, profile.unit)},
          {"rise", finite(profile.rise)},
          {"found", in_unit(profile.found, profile.unit)},
          {"verdict", profile.verdict},
          {"interval", profile.interval}};
}

Json of_page(const report::IdentifiabilityPage& page, const std::string& why_not) {
  Json view{{"known", why_not.empty()}, {"why_not", why_not}};
  view["variables"] = Json::array();
  for (std::size_t i = 0; i < page.variables.size(); ++i)
    view["variables"].push_back({{"name", page.variables[i]},
                                 {"value", page.values[i]},
                                 {"interval", page.intervals[i]},
                                 {"interval_from", page.interval_sources[i]},
                                 {"shift", page.shifts.empty() ? std::string() : page.shifts[i]}});
  view["deviations"] = finite(page.deviations);
  view["directions"] = page.directions;
  view["correlation"] = square(page.correlation);
  view["profiles"] = Json::array();
  for (const auto& profile : page.profiles) view["profiles"].push_back(profile_of(profile));
  view["bands"] = Json::array();
  for (const auto& band : page.bands)
    view["bands"].push_back({{"experiment", band.experiment},
                             {"fitted", band.fitted},
                             {"widest", band.widest},
                             {"inside", band.inside},
                             {"remarks", band.remarks}});
  view["gains"] = Json::array();
  for (const auto& gain : page.gains)
    view["gains"].push_back({{"measurement", gain.measurement},
                             {"shrinkage", finite(gain.shrinkage)},
                             {"helps", gain.helps}});
  view["left_out"] = Json::array();
  for (const auto& one : page.left_out)
    view["left_out"].push_back(
        {{"name", one.name}, {"fitted", finite(one.fitted)}, {"predicted", finite(one.predicted)}});
  view["remarks"] = page.remarks;
  view["missed"] = page.missed;
  view["residuals"] = page.residuals;
  view["priors"] = page.priors;
  view["posterior"] = nullptr;
  return view;
}

}  // namespace

Json identifiability_view(const ShelvedStudy& shelved) {
  const KeptIdentifiability kept = kept_identifiability(shelved);
  if (!kept.what) return of_page({}, kept.why_not);
  // Uncertainty bands, information gains and samples of the posterior need the whole journal, and
  // bands also trials of the predicted experiments, so the last answers are kept.
  using Question = std::pair<std::shared_ptr<const correlation::Identifiability>, std::string>;
  static KeptAnswers<Question, Json> pages(kPagesKept);
  return *pages.get({kept.what, state_of_predictions(*kept.study)}, [&] {
    const Journal journal = Journal::read(kept.study->run.journal);
    const auto bands = correlation::prediction_bands(*kept.study, *kept.what, journal);
    Json view = of_page(correlation::identifiability_page(*kept.study, *kept.what, bands), "");
    view["posterior"] = posterior_of(*kept.study, journal, bands);
    return view;
  });
}

}  // namespace latsch::studio
