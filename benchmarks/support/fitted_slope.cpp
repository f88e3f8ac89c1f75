// SPDX-License-Identifier: Apache-2.0
#include "fitted_slope.h"

#include <Eigen/Core>
#include <algorithm>
#include <cmath>
#include <functional>

#include "numerics/dense/orthogonal_factors.h"

namespace latsch::benchmarks {
namespace {

constexpr Eigen::Index kMostPowers = 7;

/// Fits the first `count` steps by `powers` odd powers; `error` is the noise of the derivative.
/// Returns nothing if there are fewer steps.
std::optional<FittedSlope> fit(const std::vector<StepValues>& steps,
                               Eigen::Index count,
                               Eigen::Index powers,
                               double noise) {
  if (count < powers) return std::nullopt;
  const double reach = steps[static_cast<std::size_t>(count - 1)].step;
  Eigen::MatrixXd of_steps(powers, count);
  Eigen::VectorXd odd(count);
  for (Eigen::Index i = 0; i < count; ++i) {
    const auto& [h, below, above] = steps[static_cast<std::size_t>(i)];
    const double x = h / reach;
    odd[i] = 0.5 * (above - below);
    of_steps(0, i) = x;
    for (Eigen::Index k = 1; k < powers; ++k) of_steps(k, i) = of_steps(k - 1, i) * x * x;
  }
  // Among all weights of the values that give the exact derivative for each of the powers, the
  // shortest vector is that of the least-squares fit.
  const Eigen::VectorXd slopes = Eigen::VectorXd::Unit(powers, 0);
  const Eigen::VectorXd weights = numerics::shortest_solution(of_steps, slopes) / reach;
  return FittedSlope{weights.dot(odd), weights.norm() * noise / std::sqrt(2.0), reach};
}

}  // namespace

std::optional<FittedSlope> fitted_slope(std::vector<StepValues> steps, double noise) {
  std::ranges::sort(steps, std::less(), &StepValues::step);
  std::optional<FittedSlope> found;
  for (Eigen::Index count = 4; count <= std::ssize(steps); ++count) {
    for (Eigen::Index powers = 2; powers <= kMostPowers; ++powers) {
      const auto here = fit(steps, count, powers, noise);
      const auto lower = fit(steps, count, powers - 1, noise);
      const auto nearer = fit(steps, count - 1, powers, noise);
      if (!nearer) break;
      const double error = std::max({here->error,
                                     std::abs(here->value - lower->value),
                                     std::abs(here->value - nearer->value)});
      if (!found || error < found->error) found = {here->value, error, here->reach};
    }
  }
  return found;
}

}  // namespace latsch::benchmarks
