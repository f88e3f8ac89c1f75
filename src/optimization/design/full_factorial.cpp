// SPDX-License-Identifier: Apache-2.0
#include "optimization/design/full_factorial.h"

#include <fmt/format.h>

#include "base/error.h"

namespace latsch {
namespace {

// Largest number of points of a design, which is held in memory and drawn as a whole.
constexpr long kMostPoints = 1'000'000;

long count_points(const DesignSpace& space, const std::vector<int>& levels) {
  if (static_cast<int>(levels.size()) != space.size()) {
    throw InputError(fmt::format("full factorial design: {} numbers of levels for {} variables",
                                 levels.size(),
                                 space.size()));
  }
  long points = 1;
  for (int i = 0; i < space.size(); ++i) {
    if (levels[i] < 1) {
      throw InputError(
          fmt::format("full factorial design: {} levels for variable \"{}\", expected "
                      "1 or more",
                      levels[i],
                      space[i].name));
    }
    points *= levels[i];
    if (points > kMostPoints) {
      throw InputError(
          fmt::format("full factorial design: more than {} points, expected fewer "
                      "levels or variables",
                      kMostPoints));
    }
  }
  return points;
}

}  // namespace

SamplingPlan full_factorial(const DesignSpace& space, const std::vector<int>& levels) {
  const long points = count_points(space, levels);
  const std::vector<double> initial = space.to_unit(space.initial());
  SamplingPlan plan;
  plan.points.reserve(points);
  for (long number = 0; number < points; ++number) {
    std::vector<double> u(space.size());
    long rest = number;
    for (int i = space.size() - 1; i >= 0; --i) {
      const long level = rest % levels[i];
      rest /= levels[i];
      u[i] = levels[i] == 1 ? initial[i] : static_cast<double>(level) / (levels[i] - 1);
    }
    plan.points.push_back(space.from_unit(u));
    for (int i = 0; i < space.size(); ++i) {
      if (levels[i] == 1) plan.points.back().values[i] = space[i].initial;  // exact bits
    }
  }
  return plan;
}

}  // namespace latsch
