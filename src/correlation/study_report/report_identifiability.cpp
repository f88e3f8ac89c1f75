// SPDX-License-Identifier: Apache-2.0
#include "correlation/study_report/report_identifiability.h"

#include <fmt/format.h>

#include <algorithm>

#include "base/units.h"
#include "correlation/analysis/measurement_gains.h"
#include "correlation/analysis/missed_values.h"
#include "correlation/doe/doe_basins.h"
#include "correlation/doe/doe_effects.h"
#include "correlation/doe/doe_shares.h"
#include "correlation/target/predictions.h"
#include "correlation/target/residuals.h"

namespace latsch::correlation {
namespace {

constexpr size_t kShownGains = 10;
constexpr size_t kShownBasins = 8;

double value_at(const DesignSpace& space, const Eigen::VectorXd& u, int variable) {
  return space.from_unit({u.begin(), u.end()}).values[variable];
}

report::ProfileCurve curve(const Study& study,
                           const Identifiability& what,
                           const TargetProfile& profile) {
  const DesignVariable& v = study.space[profile.variable];
  const Interval interval = reported_interval(study, what, profile.variable);
  report::ProfileCurve curve;
  curve.variable = v.name;
  curve.unit = v.unit;
  curve.logarithmic = v.scale == Scale::logarithmic;
  for (const ProfilePoint& point : profile.points) {
    curve.x.push_back(value_at(study.space, point.u, profile.variable));
    curve.shown.push_back(value_text(study.space, profile.variable, curve.x.back(), interval));
    curve.rise.push_back((point.S - profile.least) / profile.threshold);
  }
  curve.found = what.best.values[profile.variable];
  curve.verdict = name(profile.verdict);
  curve.interval = profile_text(study.space, profile);
  return curve;
}

std::vector<report::LeftOutExperiment> left_out(const Study& study,
                                                const CrossValidation& validation) {
  std::vector<report::LeftOutExperiment> rows;
  for (const LeftOut& fold : validation.left_out()) {
    const StudyExperiment& experiment = study.experiments[fold.group];
    rows.push_back({experiment.name,
                    difference_of(study, fold.group, fold.fitted),
                    difference_of(study, fold.group, fold.predicted)});
  }
  return rows;
}

/// Returns the gains of repeated measurements and, if the predicted experiments were simulated, of
/// measuring these.
std::vector<report::Gain> gains(const Study& study, const Identifiability& what) {
  auto all = repetition_gains(study, what);
  if (has_predictions(study)) {
    const auto points = prediction_points(study, what);
    if (const auto channels = predicted_channels(study, points)) {
      const auto predicted = prediction_gains(study, what, *channels);
      all.insert(all.end(), predicted.begin(), predicted.end());
    }
  }
  std::stable_sort(all.begin(), all.end(), [](const auto& a, const auto& b) {
    return a.shrinkage > b.shrinkage;
  });
  std::vector<report::Gain> rows;
  for (const MeasurementGain& gain : all) {
    if (rows.size() == kShownGains) break;
    rows.push_back({gain.measurement, gain.shrinkage, study.space[gain.helps].name});
  }
  return rows;
}

}  // namespace

report::IdentifiabilityPage identifiability_page(const Study& study,
                                                 const Identifiability& what,
                                                 const std::vector<ExperimentBand>& bands) {
  const Identification& identification = what.identification;
  const Confidence& c = identification.confidence();
  report::IdentifiabilityPage page;
  for (int i = 0; i < study.space.size(); ++i) {
    const DesignVariable& v = study.space[i];
    page.variables.push_back(v.name);
    const Interval interval = reported_interval(study, what, i);
    page.values.push_back(value_text(study.space, i, what.best.values[i], interval));
    page.intervals.push_back(interval_text(study, what, i));
    page.interval_sources.push_back(interval_source(study, what, i));
    if (what.refined_shift) page.shifts.push_back(shift_text(study, what, i));
    // Linear equations and variables that a stage holds leave fewer directions than variables.
    if (i >= c.directions.cols()) continue;
    page.deviations.push_back(c.deviation(i));
    page.directions.push_back(direction_text(study.space, c.directions.col(i)));
  }
  page.residuals = static_cast<int>(identification.residuals_used().size() - prior_count(study));
  page.priors = static_cast<int>(prior_count(study));
  page.correlation = c.correlation;
  for (const TargetProfile& profile : identification.profiles()) {
    page.profiles.push_back(curve(study, what, profile));
  }
  if (what.cross_validation) page.left_out = left_out(study, *what.cross_validation);
  for (size_t e = 0; e < bands.size(); ++e) {
    const StudyExperiment& experiment = study.experiments[e];
    std::vector<std::string> remarks = bands[e].remarks;
    if (bands[e].delay) remarks.insert(remarks.begin(), "delay " + bands[e].delay->in_words());
    for (const NuisanceRow& row : bands[e].nuisance) remarks.push_back(row.in_words());
    for (const NuisanceCost& cost : bands[e].nuisance_costs)
      remarks.push_back(cost_text(study, cost));
    for (const std::string& remark : bands[e].nuisance_remarks) remarks.push_back(remark);
    page.bands.push_back({experiment.name,
                          experiment.fitted,
                          widest_text(experiment, bands[e]),
                          inside_text(bands[e]),
                          std::move(remarks)});
  }
  page.gains = gains(study, what);
  page.remarks = remarks(study, what);
  for (const MissedValue& one : missed_values(study, what))
    page.missed.push_back(one.in_words(study.space));
  return page;
}

std::optional<report::Basins> basins_of(const Study& study, const std::vector<RatedTrial>& trials) {
  const auto design = evaluated_design(study, trials);
  if (!design) return std::nullopt;
  const auto found = doe_basins(study, *design, trials);
  if (!found) return std::nullopt;
  report::Basins page;
  page.design = fmt::format("{}, {} points", found->design, found->points);
  page.count = static_cast<int>(found->basins.size());
  page.doubt = found->doubt;
  for (const DesignVariable& v : study.space.variables()) page.variables.push_back(v.name);
  for (const DoeBasin& basin : found->basins) {
    if (page.rows.size() == kShownBasins) break;
    report::BasinRow row{basin.target, basin.points, {}};
    for (int i = 0; i < study.space.size(); ++i) {
      row.values.push_back(format_quantity(basin.lowest.values[i], study.space[i].unit, 4));
    }
    page.rows.push_back(std::move(row));
  }
  return page;
}

std::vector<report::SharesOfResponse> shares_of(const Study& study, const Journal& journal) {
  if (!study.doe || !study.doe->asks_shares) return {};
  std::vector<report::SharesOfResponse> all;
  for (const ResponseShares& one : doe_shares(study, *study.doe, journal).responses) {
    report::SharesOfResponse& page = all.emplace_back();
    page.response = one.response;
    page.explained = one.shares.explained;
    page.is_trusted = one.shares.is_trusted();
    for (std::size_t i = 0; i < one.shares.first.size(); ++i) {
      const VarianceShare &first = one.shares.first[i], &total = one.shares.total[i];
      page.of.push_back({study.space[static_cast<int>(i)].name,
                         first.value,
                         first.lower,
                         first.upper,
                         total.value,
                         total.lower,
                         total.upper});
    }
  }
  return all;
}

std::vector<report::EffectRow> effects_of(const Study& study,
                                          const std::vector<RatedTrial>& trials) {
  if (!study.doe) return {};
  std::vector<report::EffectRow> rows;
  for (const ElementaryEffects& e : doe_effects(study, *study.doe, trials)) {
    if (e.effects == 0) return {};  // never evaluated
    rows.push_back(
        {study.space[static_cast<int>(rows.size())].name, e.mu_star, e.mu, e.sigma, e.effects});
  }
  return rows;
}

}  // namespace latsch::correlation
