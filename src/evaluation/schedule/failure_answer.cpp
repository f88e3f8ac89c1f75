// SPDX-License-Identifier: Apache-2.0
#include "evaluation/schedule/failure_answer.h"

#include <cassert>
#include <cmath>
#include <cstddef>

namespace latsch {
namespace {

// Violation that every constraint of a failed point is given, because it is not known to fulfill
// any.
constexpr double kViolated = 1.0;

double squared_distance(const std::vector<double>& u, const std::vector<double>& v) {
  double sum = 0.0;
  for (std::size_t i = 0; i < u.size(); ++i) sum += (u[i] - v[i]) * (u[i] - v[i]);
  return sum;
}

/// Returns the successful step nearest to the point, the first one if several are equally near;
/// nullptr if none succeeded.
const Step* nearest_success(const DesignSpace& space,
                            const std::vector<Step>& steps,
                            const DesignPoint& point) {
  const std::vector<double> u = space.to_unit(point);
  const Step* nearest = nullptr;
  double least = 0.0;
  for (const Step& step : steps) {
    if (!step.outcome) continue;
    const double distance = squared_distance(space.to_unit(step.point), u);
    if (nearest && distance >= least) continue;
    nearest = &step;
    least = distance;
  }
  return nearest;
}

DesignPoint middle(const DesignSpace& space, const DesignPoint& a, const DesignPoint& b) {
  std::vector<double> u = space.to_unit(a);
  const std::vector<double> v = space.to_unit(b);
  for (std::size_t i = 0; i < u.size(); ++i) u[i] = 0.5 * (u[i] + v[i]);
  return space.from_unit(u);
}

}  // namespace

std::optional<Score> recovered(const FailurePolicy& policy, const std::vector<Step>& before) {
  for (const Step& step : before) {
    if (!step.outcome) continue;
    const Score& like = *step.outcome;
    const double each = std::sqrt(policy.penalty / static_cast<double>(like.residuals.size()));
    Score score{.value = policy.penalty};
    score.residuals.assign(like.residuals.size(), each);
    score.constraints.assign(like.constraints.size(), kViolated);
    score.equations.assign(like.equations.size(), kViolated);
    return score;
  }
  return std::nullopt;
}

std::optional<Continuation> continued(const FailurePolicy& policy,
                                      const std::vector<Step>& before,
                                      const DesignPoint& failed,
                                      std::optional<std::span<const DesignPoint>> behind,
                                      const Ask& ask) {
  assert(policy.space && "the distance to the nearest success is one in the unit cube");
  const DesignSpace& space = *policy.space;
  Continuation continuation;
  const Step* start = nearest_success(space, before, failed);
  if (!start) return continuation;
  DesignPoint source = start->point, target = failed;
  for (int halving = 0; halving < policy.halvings; ++halving) {
    const DesignPoint next = middle(space, source, target);
    // The two points are neighbors in floating-point numbers.
    if (next == source || next == target) break;
    std::vector<DesignPoint> wanted{next};
    if (behind) {
      wanted.push_back(middle(space, next, target));
      wanted.push_back(middle(space, source, next));
      wanted.insert(wanted.end(), behind->begin(), behind->end());
    }
    const Result<Score>* outcome = ask(wanted);
    if (!outcome) return std::nullopt;
    continuation.steps.push_back({next, *outcome});
    if (*outcome) continuation.answer = **outcome;
    (*outcome ? source : target) = next;
  }
  return continuation;
}

}  // namespace latsch
