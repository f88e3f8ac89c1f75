// SPDX-License-Identifier: Apache-2.0
#include "correlation/doe/doe_shares.h"

#include <fmt/format.h>

#include <map>

#include "correlation/target/study_trials.h"
#include "optimization/problem/point_vector.h"

namespace latsch::correlation {
namespace {

constexpr double kMostFailed = 0.2;  // share of the points

struct Responses {
  std::vector<std::string> names;
  std::vector<std::vector<double>> values;  // one vector for each name
};

/// Returns the response of an experiment at one trial.
double response(const StudyExperiment& experiment, const Comparison& comparison) {
  if (comparison.differences.size() != 1) return comparison.value;
  const Observable& observable = *experiment.observable;
  return observable.measured_values()[0] - observable.scales()[0] * comparison.differences[0];
}

}  // namespace

DoeShares doe_shares(const Study& study, const StudyDesign& design, const Journal& journal) {
  const SamplingPlan points = plan(design, study.space);
  std::map<std::string, std::vector<double>> found;  // responses, keyed by the point's bits
  for (const DesignPoint& point : points.points) found[point.bits()];
  std::vector<std::string> names{"target"};
  for (const StudyExperiment& experiment : study.experiments) {
    if (!experiment.fitted) continue;
    const bool is_one = experiment.observable->measured_values().size() == 1;
    names.push_back((is_one ? "value of " : "target of ") + experiment.name);
  }
  const Objective target = objective(study);
  journal.for_each([&](const Trial& trial) {
    const auto at = found.find(trial.point.bits());
    if (at == found.end() || !trial.outcome.result || !at->second.empty()) return;
    const auto score = target(trial.point, *trial.outcome.result);
    if (!score) return;
    std::vector<double> values{score->value};
    for (const StudyExperiment& experiment : study.experiments) {
      if (!experiment.fitted) continue;
      const auto comparison = comparison_of(experiment, study.experiments, *trial.outcome.result);
      if (!comparison) return;
      values.push_back(response(experiment, *comparison));
    }
    at->second = std::move(values);
  });
  std::erase_if(found, [](const auto& one) { return one.second.empty(); });

  DoeShares all;
  all.points = static_cast<int>(found.size());
  const auto asked = points.points.size();
  all.missing = static_cast<int>(asked - found.size());
  if (static_cast<double>(asked - found.size()) > kMostFailed * static_cast<double>(asked)) {
    all.refusal = fmt::format(
        "{} of {} points have no target, more than a fifth: the others do not cover the space",
        asked - found.size(),
        asked);
    return all;
  }
  if (all.points < kFewestPointsOfShares) {
    all.refusal =
        fmt::format("{} points have a target, expected {} at least: raise points of [doe]",
                    all.points,
                    kFewestPointsOfShares);
    return all;
  }
  // Rows keep the order of the design.
  Eigen::MatrixXd at(all.points, study.space.size());
  Eigen::MatrixXd values(all.points, std::ssize(names));
  Eigen::Index row = 0;
  for (const DesignPoint& point : points.points) {
    const auto known = found.find(point.bits());
    if (known == found.end()) continue;
    at.row(row) = to_vector(study.space.to_unit(point)).transpose();
    for (std::size_t k = 0; k < names.size(); ++k)
      values(row, static_cast<Eigen::Index>(k)) = known->second[k];
    ++row;
    found.erase(known);  // a point that the design has twice counts once
  }
  for (std::size_t k = 0; k < names.size(); ++k)
    all.responses.push_back({names[k], variance_shares(at.topRows(row), values.col(k).head(row))});
  return all;
}

}  // namespace latsch::correlation
