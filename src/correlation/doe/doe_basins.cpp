// SPDX-License-Identifier: Apache-2.0
#include "correlation/doe/doe_basins.h"

#include <fmt/format.h>

#include <cmath>
#include <limits>
#include <map>

#include "optimization/design/basins.h"
#include "optimization/problem/point_vector.h"

namespace latsch::correlation {
namespace {

using Targets = std::map<std::string, double>;  // target of each point, keyed by the point's bits

constexpr double kLeastShare = 0.9;  // least share of a design's points that must have a target
constexpr int kMostSampledLevels = 41;
// limit for points without a grid: the time to find neighbors grows with the square of their number
constexpr int kMostScatteredPoints = 10'000;

Targets targets_of(const std::vector<RatedTrial>& trials) {
  Targets targets;
  for (const RatedTrial& trial : trials) targets.emplace(trial.point.bits(), trial.target);
  return targets;
}

/// Returns the targets of the plan's points, NaN for a point without one.
std::vector<double> values_of(const SamplingPlan& plan, const Targets& targets) {
  std::vector<double> values;
  for (const DesignPoint& point : plan.points) {
    const auto at = targets.find(point.bits());
    values.push_back(at != targets.end() ? at->second : std::numeric_limits<double>::quiet_NaN());
  }
  return values;
}

int known(const std::vector<double>& values) {
  int count = 0;
  for (double value : values) count += std::isfinite(value);
  return count;
}

bool complete(const std::vector<double>& values) {
  return known(values) >= kLeastShare * static_cast<double>(values.size());
}

std::vector<Eigen::VectorXd> in_the_unit_cube(const DesignSpace& space, const SamplingPlan& plan) {
  std::vector<Eigen::VectorXd> all;
  for (const DesignPoint& point : plan.points) all.push_back(to_vector(space.to_unit(point)));
  return all;
}

}  // namespace

std::optional<DoeBasins> doe_basins(const Study& study,
                                    const StudyDesign& design,
                                    const std::vector<RatedTrial>& trials) {
  if (design.kind == DesignKind::morris) return std::nullopt;
  const bool grid = design.kind == DesignKind::full_factorial;
  if (!grid && design.points > kMostScatteredPoints) return std::nullopt;
  const SamplingPlan plan = correlation::plan(design, study.space);
  const auto values = values_of(plan, targets_of(trials));
  if (!complete(values)) return std::nullopt;
  DoeBasins found;
  found.design = design.name();
  found.points = known(values);
  Neighbors neighbors;
  if (grid) {
    found.design += fmt::format(", {}", fmt::join(design.levels, " x "));
    neighbors = grid_neighbors(design.levels);
    found.doubt = grid_doubt(values, design.levels);
  } else {
    const auto points = in_the_unit_cube(study.space, plan);
    neighbors = nearest_neighbors(points, 2 * study.space.size() + 2);
    found.doubt = scatter_doubt(values, points);
  }
  for (const Basin& basin : find_basins(values, neighbors)) {
    found.basins.push_back({plan.points[basin.lowest], basin.value, basin.points});
  }
  return found;
}

std::optional<StudyDesign> evaluated_design(const Study& study,
                                            const std::vector<RatedTrial>& trials) {
  const Targets targets = targets_of(trials);
  if (study.doe && complete(values_of(plan(*study.doe, study.space), targets))) return study.doe;
  for (int n = kMostSampledLevels; n >= 3; --n) {
    const StudyDesign grid{.levels = std::vector<int>(study.space.size(), n)};
    if (std::pow(n, study.space.size()) * kLeastShare > static_cast<double>(targets.size()))
      continue;
    if (complete(values_of(plan(grid, study.space), targets))) return grid;
  }
  return std::nullopt;
}

}  // namespace latsch::correlation
