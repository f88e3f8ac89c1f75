// SPDX-License-Identifier: Apache-2.0
#include "correlation/doe/doe_surface.h"

#include <fmt/format.h>

#include <limits>
#include <map>
#include <optional>

#include "base/units.h"
#include "optimization/design/full_factorial.h"

namespace latsch::correlation {
namespace {

using Targets = std::map<std::string, double>;  // target of each point, keyed by the point's bits

constexpr int kMostDrawnLevels = 41;
constexpr double kLeastShareDrawn =
    0.9;  // least share of a grid's points with a target; below, the grid is not in this journal

struct Grid {
  std::vector<int> levels;
  DesignPoint best;
};

std::optional<Grid> grid_with(const Study& study,
                              const std::vector<int>& levels,
                              const Targets& targets) {
  double points = 1.0;
  for (int n : levels) points *= n;
  if (points > static_cast<double>(targets.size()) / kLeastShareDrawn) return std::nullopt;
  const SamplingPlan plan = full_factorial(study.space, levels);
  Grid grid{levels, {}};
  double least = std::numeric_limits<double>::infinity();
  size_t known = 0;
  for (const DesignPoint& point : plan.points) {
    const auto at = targets.find(point.bits());
    if (at == targets.end()) continue;
    ++known;
    if (at->second < least) {
      least = at->second;
      grid.best = point;
    }
  }
  if (static_cast<double>(known) < kLeastShareDrawn * static_cast<double>(plan.points.size())) {
    return std::nullopt;
  }
  return grid;
}

/// Returns the study's own [doe], or the finest grid of equal levels (`latsch doe --levels`).
std::optional<Grid> find_grid(const Study& study, const Targets& targets) {
  std::optional<Grid> found;
  if (study.doe && study.doe->kind == DesignKind::full_factorial) {
    found = grid_with(study, study.doe->levels, targets);
  }
  for (int n = kMostDrawnLevels; n >= 3 && !found; --n) {
    found = grid_with(study, std::vector<int>(study.space.size(), n), targets);
  }
  return found;
}

/// Returns the levels of variable i in ascending order.
std::vector<double> levels_of(const Study& study, const Grid& grid, int i) {
  std::vector<int> only(study.space.size(), 1);
  only[i] = grid.levels[i];
  std::vector<double> values;
  for (const DesignPoint& point : full_factorial(study.space, only).points) {
    values.push_back(point.values[i]);
  }
  return values;
}

report::Surface surface(const Study& study,
                        const Grid& grid,
                        const Targets& targets,
                        int i,
                        int j,
                        const DesignPoint& found) {
  const DesignVariable &x = study.space[i], &y = study.space[j];
  report::Surface s;
  s.x_name = x.name;
  s.y_name = y.name;
  s.x_unit = x.unit;
  s.y_unit = y.unit;
  s.x_logarithmic = x.scale == Scale::logarithmic;
  s.y_logarithmic = y.scale == Scale::logarithmic;
  s.x = levels_of(study, grid, i);
  s.y = levels_of(study, grid, j);
  s.target.resize(static_cast<Eigen::Index>(s.x.size()), static_cast<Eigen::Index>(s.y.size()));
  DesignPoint point = grid.best;
  for (Eigen::Index a = 0; a < s.target.rows(); ++a) {
    for (Eigen::Index b = 0; b < s.target.cols(); ++b) {
      point.values[i] = s.x[a];
      point.values[j] = s.y[b];
      const auto at = targets.find(point.bits());
      s.target(a, b) = at != targets.end() ? at->second : std::numeric_limits<double>::quiet_NaN();
    }
  }
  for (int k = 0; k < study.space.size(); ++k) {
    if (k == i || k == j) continue;
    s.held += fmt::format("{}{} = {}",
                          s.held.empty() ? "" : ", ",
                          study.space[k].name,
                          format_quantity(grid.best.values[k], study.space[k].unit, 4));
  }
  s.initial = Eigen::Vector2d(x.initial, y.initial);
  s.found = Eigen::Vector2d(found.values[i], found.values[j]);
  return s;
}

}  // namespace

std::vector<report::Surface> doe_surfaces(const Study& study,
                                          const std::vector<RatedTrial>& trials,
                                          const DesignPoint& found) {
  Targets targets;
  for (const RatedTrial& trial : trials) targets.emplace(trial.point.bits(), trial.target);
  const auto grid = find_grid(study, targets);
  std::vector<report::Surface> surfaces;
  if (!grid) return surfaces;
  for (int i = 0; i < study.space.size(); ++i) {
    for (int j = i + 1; j < study.space.size(); ++j) {
      if (grid->levels[i] > 1 && grid->levels[j] > 1) {
        surfaces.push_back(surface(study, *grid, targets, i, j, found));
      }
    }
  }
  return surfaces;
}

}  // namespace latsch::correlation
