// SPDX-License-Identifier: Apache-2.0
#include "correlation/campaign/campaign_start.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "base/text.h"
#include "correlation/target/compared_trial.h"
#include "correlation/target/residuals.h"

namespace latsch::correlation {
namespace {

// Information of a variable that is anywhere in its range.
constexpr double kInsideRange = 12.0;
// Length of differences, in ranges, if no fit has chosen one.
constexpr double kUnfittedDifference = 0.01;
// Deviation of residuals below which they are rounding and no noise of a laboratory.
constexpr double kRoundingAlone = 1e-6;

std::vector<int> free_variables(const Study& study) {
  if (!study.free.empty()) return study.free;
  std::vector<int> all;
  for (int i = 0; i < study.space.size(); ++i) all.push_back(i);
  return all;
}

/// Returns the deviation of the values of an experiment, SI, as the fit found it or as stated;
/// nullopt if neither is known.
std::optional<double> deviation_of(const Study& study,
                                   std::size_t experiment,
                                   const Identifiability* what) {
  const StudyExperiment& of = study.experiments[experiment];
  const std::vector<double>& scales = of.observable->scales();
  double squares = 0.0, count = 0.0;
  if (what) {
    const auto rows = residual_rows(study);
    const auto& used = what->identification.residuals_used();
    // A new test is no neighbor of others, so it has the deviation of a single value.
    const double sigma = what->identification.confidence().sigma;
    const std::vector<double> deviations = residual_traits(study).deviations;
    std::size_t own = 0;
    for (Eigen::Index k = 0; k < std::ssize(used); ++k) {
      const ResidualRow& row = rows[static_cast<std::size_t>(used[static_cast<std::size_t>(k)])];
      if (row.experiment != static_cast<int>(experiment)) continue;
      const double scale = own < scales.size() ? scales[own] : 1.0;
      const double residual =
          sigma * deviations[static_cast<std::size_t>(used[static_cast<std::size_t>(k)])];
      squares += std::pow(residual * row.unit * scale, 2);
      count += 1.0;
      ++own;
    }
  } else if (of.noise) {
    const std::vector<double> stated = stated_deviations(of);
    for (std::size_t k = 0; k < stated.size(); ++k) {
      squares += std::pow(stated[k] * (k < scales.size() ? scales[k] : 1.0), 2);
      count += 1.0;
    }
  }
  if (count == 0.0) return std::nullopt;
  return std::sqrt(squares / count);
}

/// Sets the noise of every measured channel: as stated in [design], else that of the fitted
/// experiments that compare it.
Status set_noise(const Study& study, const Identifiability* what, CampaignStart& start) {
  const CampaignSettings& campaign = *study.campaign;
  for (const std::string& channel : campaign.measures) {
    if (const auto stated = campaign.noise.find(channel); stated != campaign.noise.end()) {
      start.noise.push_back({stated->second, true});
      continue;
    }
    double squares = 0.0, count = 0.0;
    for (std::size_t e = 0; e < study.experiments.size(); ++e) {
      const StudyExperiment& experiment = study.experiments[e];
      const auto& asks = experiment.observable->asks();
      const std::string name = campaign.test + "/" + channel;
      if (!experiment.fitted || experiment.observable->compared(experiment.objective) != name ||
          std::find(asks.begin(), asks.end(), name) == asks.end())
        continue;
      if (const auto deviation = deviation_of(study, e, what)) {
        squares += *deviation * *deviation;
        count += 1.0;
      }
    }
    if (count == 0.0)
      return Failure{fmt::format(
          "the noise of {} is not known, because no fitted experiment with a known noise compares "
          "it; state it in [design], such as noise = {{{} = \"1 %\"}}",
          channel,
          channel)};
    start.noise.push_back({{.absolute = std::sqrt(squares / count)}, false});
  }
  return {};
}

Result<CampaignStart> known_after_fit(const Study& study, const Identifiability& what) {
  const Confidence& c = what.identification.confidence();
  if (std::isnan(c.sigma))
    return Failure{
        "the fit has no more values than variables, so nothing is known about their noise and "
        "about the variables; state the noise of the experiments"};
  if (!(c.sigma > kRoundingAlone))
    return Failure{
        "the fit leaves rounding alone and no noise, so every variable counts as known exactly; "
        "state the noise of the experiments, such as noise = \"1 %\""};
  CampaignStart start;
  start.point = what.point;
  start.free = free_variables(study);
  const Eigen::MatrixXd J =
      c.noise.cwiseInverse().asDiagonal() * what.identification.linearization().J;
  const Eigen::MatrixXd own = J(Eigen::all, start.free);
  start.data = own.transpose() * own;
  start.is_fitted = true;
  start.lengths = what.identification.lengths();
  if (start.lengths.size() != study.space.size())
    start.lengths = Eigen::VectorXd::Constant(study.space.size(), kUnfittedDifference);
  return start;
}

CampaignStart known_before_fit(const Study& study) {
  CampaignStart start;
  start.free = free_variables(study);
  start.point = study.space.initial();
  start.lengths = Eigen::VectorXd::Constant(study.space.size(), kUnfittedDifference);
  Score score;
  for (const PriorResidual& prior : prior_residuals(study.space, start.point)) {
    score.residuals.push_back(prior.residual);
    for (int i = 0; i < study.space.size(); ++i)
      score.jacobian.push_back(prior.variable == i ? prior.slope : 0.0);
  }
  const auto n = std::ssize(start.free);
  start.data = Eigen::MatrixXd::Zero(n, n);
  if (score.residuals.empty()) return start;
  const Eigen::MatrixXd J = study.space.unit_jacobian(start.point, score);
  const Eigen::MatrixXd own = J(Eigen::all, start.free);
  start.data = own.transpose() * own;
  return start;
}

}  // namespace

Result<CampaignStart> start_after_fit(const Study& study, const Identifiability& what) {
  auto start = known_after_fit(study, what);
  if (!start) return start;
  if (const Status known = set_noise(study, &what, *start); !known) return known.failure();
  return start;
}

Result<CampaignStart> start_of_rival(const Study& rival, const Identifiability* what) {
  if (what) return known_after_fit(rival, *what);
  return known_before_fit(rival);
}

Result<CampaignStart> start_before_fit(const Study& study) {
  const bool has_prior =
      std::any_of(study.space.variables().begin(),
                  study.space.variables().end(),
                  [](const DesignVariable& variable) { return variable.prior.has_value(); });
  if (!has_prior)
    return Failure{
        "the study has not been fitted and no variable has a prior, so a design does not know "
        "where the variables are; start with latsch run, or state prior = of a variable"};
  CampaignStart start = known_before_fit(study);
  if (const Status known = set_noise(study, nullptr, start); !known) return known.failure();
  return start;
}

Eigen::MatrixXd present_information(const CampaignStart& start) {
  return start.data +
         kInsideRange * Eigen::MatrixXd::Identity(start.data.rows(), start.data.cols());
}

}  // namespace latsch::correlation
