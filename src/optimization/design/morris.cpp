// SPDX-License-Identifier: Apache-2.0
#include "optimization/design/morris.h"

#include <fmt/format.h>

#include <cassert>
#include <cmath>
#include <numeric>
#include <set>
#include <string>

#include "base/error.h"
#include "base/random.h"

namespace latsch {
namespace {

constexpr int kMostTrajectories = 10'000;
constexpr int kMostLevels = 100;

/// Returns a trajectory that starts at a random point of the grid. Coordinates are whole multiples
/// of 1 / (levels - 1). A step is levels / 2 of these, upward from the lower half of the grid and
/// downward from the upper half, so that it always stays in the grid.
std::vector<DesignPoint> trajectory(const DesignSpace& space, int levels, RandomStream random) {
  const int n = space.size();
  std::vector<std::uint64_t> step(n);
  for (auto& s : step) s = random.below(levels);
  std::vector<int> order(n);
  std::iota(order.begin(), order.end(), 0);
  for (int i = n - 1; i > 0; --i) std::swap(order[i], order[random.below(i + 1)]);

  const auto point = [&] {
    std::vector<double> u;
    for (auto s : step) u.push_back(static_cast<double>(s) / (levels - 1));
    return space.from_unit(u);
  };
  const std::uint64_t delta = levels / 2;
  std::vector<DesignPoint> points{point()};
  for (int i : order) {
    step[i] = step[i] < delta ? step[i] + delta : step[i] - delta;
    points.push_back(point());
  }
  return points;
}

ElementaryEffects summary(const std::vector<double>& d) {
  ElementaryEffects effects;
  effects.effects = static_cast<int>(d.size());
  if (d.empty()) return effects;
  for (double effect : d) {
    effects.mu += effect / static_cast<double>(d.size());
    effects.mu_star += std::abs(effect) / static_cast<double>(d.size());
  }
  double squares = 0.0;
  for (double effect : d) squares += (effect - effects.mu) * (effect - effects.mu);
  if (d.size() > 1) effects.sigma = std::sqrt(squares / static_cast<double>(d.size() - 1));
  return effects;
}

/// Returns the variable in which two consecutive points differ.
int changed(const DesignPoint& a, const DesignPoint& b) {
  int i = 0;
  while (a.values[i] == b.values[i]) ++i;
  return i;
}

}  // namespace

SamplingPlan MorrisDesign::plan() const {
  SamplingPlan plan;
  std::set<std::string> known;
  for (const auto& trajectory : trajectories) {
    for (const DesignPoint& point : trajectory) {
      if (known.insert(point.bits()).second) plan.points.push_back(point);
    }
  }
  return plan;
}

MorrisDesign morris(const DesignSpace& space, int trajectories, std::uint64_t seed, int levels) {
  if (trajectories < 2 || trajectories > kMostTrajectories) {
    throw InputError(
        fmt::format("Morris: {} trajectories, expected 2 to {}", trajectories, kMostTrajectories));
  }
  if (levels < 2 || levels > kMostLevels || levels % 2 != 0) {
    throw InputError(
        fmt::format("Morris: {} levels, expected an even number up to {}", levels, kMostLevels));
  }
  MorrisDesign design;
  for (int t = 0; t < trajectories; ++t) {
    design.trajectories.push_back(trajectory(space, levels, RandomStream(seed, t)));
  }
  return design;
}

std::vector<ElementaryEffects> elementary_effects(
    const DesignSpace& space,
    const MorrisDesign& design,
    const std::vector<std::vector<std::optional<double>>>& values) {
  assert(values.size() == design.trajectories.size());
  std::vector<std::vector<double>> d(space.size());
  for (size_t t = 0; t < values.size(); ++t) {
    const auto& points = design.trajectories[t];
    assert(values[t].size() == points.size());
    for (size_t k = 0; k + 1 < points.size(); ++k) {
      if (!values[t][k] || !values[t][k + 1]) continue;
      const int i = changed(points[k], points[k + 1]);
      const double delta = space.to_unit(points[k + 1])[i] - space.to_unit(points[k])[i];
      // Equation (2.1) of Morris.
      d[i].push_back((*values[t][k + 1] - *values[t][k]) / delta);
    }
  }
  std::vector<ElementaryEffects> effects;
  for (const auto& of_variable : d) effects.push_back(summary(of_variable));
  return effects;
}

}  // namespace latsch
