// SPDX-License-Identifier: Apache-2.0
#include "correlation/doe/doe_conflict.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <map>

#include "correlation/target/study_trials.h"
#include "numerics/dense/cholesky.h"
#include "optimization/problem/point_vector.h"

namespace latsch::correlation {
namespace {

constexpr double kAssumedNoise = 0.01;  // share of the scale, if no noise is stated

/// Returns the deviation of each value in units of its scale, as errors are.
std::vector<double> deviations_of(const StudyExperiment& experiment) {
  const ObjectiveSettings plain;  // compares the values themselves, not their roots
  const bool is_stated = experiment.noise && !experiment.estimates_noise;
  if (is_stated) return experiment.observable->deviations(*experiment.noise, plain);
  return std::vector<double>(experiment.values(), kAssumedNoise);
}

/// Returns the slopes of the values by each variable, fitted over the points.
Eigen::VectorXd fitted_slopes(const Eigen::MatrixXd& at, const Eigen::VectorXd& values) {
  Eigen::MatrixXd A(at.rows(), at.cols() + 1);
  A << at, Eigen::VectorXd::Ones(at.rows());
  const numerics::Cholesky factor(A.transpose() * A);
  if (!factor.is_positive_definite()) return Eigen::VectorXd::Zero(at.cols());
  return factor.solve(Eigen::VectorXd(A.transpose() * values)).head(at.cols());
}

/// Judges one experiment by its errors over their deviations, points x values; NaN: not computed.
UnreachedValues unreached(const StudyExperiment& experiment,
                          const Eigen::MatrixXd& errors,
                          const Eigen::MatrixXd& at) {
  UnreachedValues row;
  Eigen::VectorXd distance = Eigen::VectorXd::Zero(errors.rows());
  for (Eigen::Index k = 0; k < errors.cols(); ++k) {
    const Eigen::VectorXd column = errors.col(k);
    if (!column.array().isFinite().any()) continue;
    ++row.values;
    double nearest = INFINITY;
    bool is_below = false, is_above = false;
    for (const double error : column) {
      if (!std::isfinite(error)) continue;
      nearest = std::min(nearest, std::abs(error));
      (error > 0.0 ? is_below : is_above) = true;
    }
    if (nearest <= kReach) continue;
    if (is_below && is_above) {
      ++row.between;
      continue;
    }
    ++row.beyond;
    distance += column.cwiseAbs();
    if (nearest <= row.farthest_by) continue;
    row.farthest_by = nearest;
    row.farthest = experiment.observable->rows()[static_cast<std::size_t>(k)];
  }
  if (row.beyond == 0) return row;
  std::vector<Eigen::Index> known;
  for (Eigen::Index p = 0; p < distance.size(); ++p)
    if (std::isfinite(distance[p])) known.push_back(p);
  const Eigen::VectorXd slopes =
      fitted_slopes(at(known, Eigen::all), distance(known) / static_cast<double>(row.beyond));
  Eigen::Index mover = 0;
  if (slopes.cwiseAbs().maxCoeff(&mover) > 0.0) {
    row.mover = static_cast<int>(mover);
    row.is_raised = slopes[mover] < 0.0;
  }
  return row;
}

}  // namespace

DoeConflict doe_conflict(const Study& study,
                         const std::vector<DesignPoint>& points,
                         const Journal& journal) {
  std::map<std::string, Channels> found;  // keyed by the point's bits
  for (const DesignPoint& point : points) found[point.bits()];
  std::map<std::string, bool> succeeded;
  journal.for_each([&](const Trial& trial) {
    const auto at = found.find(trial.point.bits());
    if (at == found.end() || !trial.outcome.result || succeeded[at->first]) return;
    at->second = *trial.outcome.result;
    succeeded[at->first] = true;
  });
  std::vector<const DesignPoint*> known;  // in the order of the design, each once
  for (const DesignPoint& point : points)
    if (std::exchange(succeeded[point.bits()], false)) known.push_back(&point);
  DoeConflict all;
  all.points = static_cast<int>(known.size());
  const int fewest = kPointsOfUnknown * (study.space.size() + 1);
  if (all.points < fewest) {
    all.refusal = fmt::format(
        "{} point{} of a design succeeded, expected {} at least, ten for each variable and ten "
        "more: add a scattered [doe], for example design = \"sobol\" and points = {}, and run "
        "latsch "
        "doe",
        all.points,
        all.points == 1 ? "" : "s",
        fewest,
        fewest);
    return all;
  }
  Eigen::MatrixXd at(all.points, study.space.size());
  for (Eigen::Index p = 0; p < at.rows(); ++p)
    at.row(p) = to_vector(study.space.to_unit(*known[static_cast<std::size_t>(p)])).transpose();
  for (std::size_t e = 0; e < study.experiments.size(); ++e) {
    const StudyExperiment& experiment = study.experiments[e];
    if (!experiment.fitted || experiment.objective.weight == 0.0) continue;
    const std::vector<double> sigma = deviations_of(experiment);
    Eigen::MatrixXd errors = Eigen::MatrixXd::Constant(
        all.points, static_cast<Eigen::Index>(experiment.values()), std::nan(""));
    for (Eigen::Index p = 0; p < at.rows(); ++p) {
      const auto comparison = comparison_of(
          experiment, study.experiments, found[known[static_cast<std::size_t>(p)]->bits()]);
      if (!comparison) continue;
      for (std::size_t k = 0; k < sigma.size(); ++k)
        errors(p, static_cast<Eigen::Index>(k)) = comparison->errors[k] / sigma[k];
      for (const int missing : comparison->pairing.missing) errors(p, missing) = std::nan("");
    }
    UnreachedValues row = unreached(experiment, errors, at);
    row.experiment = static_cast<int>(e);
    row.noise_assumed = !experiment.noise || experiment.estimates_noise;
    all.rows.push_back(std::move(row));
  }
  return all;
}

std::string in_words(const Study& study, const UnreachedValues& row) {
  std::string text =
      row.beyond == 0 ? fmt::format("all {} values lie among the points", row.values)
                      : fmt::format("{} of {} values beyond every point, {} by {:.1f} deviations",
                                    row.beyond,
                                    row.values,
                                    row.farthest,
                                    row.farthest_by);
  if (row.mover >= 0)
    text += fmt::format("; most moved by {}, which would have to be {}",
                        study.space[row.mover].name,
                        row.is_raised ? "larger" : "smaller");
  if (row.between > 0)
    text += fmt::format("; {} between points that are too far apart to tell", row.between);
  if (row.noise_assumed) text += "; 1 % counts as a deviation, because no noise is stated";
  return text;
}

}  // namespace latsch::correlation
