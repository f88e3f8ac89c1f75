// SPDX-License-Identifier: Apache-2.0
#include "correlation/posterior/sampled_bands.h"

#include <algorithm>
#include <cmath>

#include "correlation/target/residuals.h"
#include "optimization/posterior/chain_diagnostics.h"

namespace latsch::correlation {
namespace {

/// Returns the computed value for a difference.
double computed_value(const StudyExperiment& experiment, double measured, double scale, double d) {
  if (experiment.objective.compared == Compared::root_force)
    return measured * std::pow(std::max(0.0, 1.0 - d), 2);
  return measured - scale * d;
}

}  // namespace

std::vector<SampledBand> sampled_bands(const Study& study,
                                       const std::vector<Eigen::Index>& rows,
                                       const Eigen::MatrixXd& residuals) {
  const std::vector<ResidualRow> all = residual_rows(study);
  std::vector<SampledBand> bands;
  for (std::size_t k = 0; k < rows.size(); ++k) {
    const ResidualRow& row = all[static_cast<std::size_t>(rows[k])];
    if (row.experiment < 0) continue;
    const StudyExperiment& experiment = study.experiments[static_cast<std::size_t>(row.experiment)];
    if (bands.empty() || bands.back().experiment != row.experiment) {
      const std::vector<double> unknown(experiment.values(), NAN);
      bands.push_back({row.experiment, unknown, unknown, unknown});
    }
    // all rows of an experiment are successive, those without a partner among them
    const auto first = std::find_if(all.begin(), all.end(), [&](const ResidualRow& one) {
      return one.experiment == row.experiment;
    });
    const auto value =
        static_cast<std::size_t>(rows[k]) - static_cast<std::size_t>(first - all.begin());
    const double measured = experiment.observable->measured_values()[value];
    const double scale = experiment.observable->scales()[value];
    Eigen::VectorXd y = residuals.row(static_cast<Eigen::Index>(k)).transpose();
    for (double& one : y) one = computed_value(experiment, measured, scale, row.unit * one);
    bands.back().lower[value] = quantile_of(y, 0.025);
    bands.back().median[value] = quantile_of(y, 0.5);
    bands.back().upper[value] = quantile_of(y, 0.975);
  }
  return bands;
}

}  // namespace latsch::correlation
