// SPDX-License-Identifier: Apache-2.0
#include "optimization/identifiability/robust_loss.h"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <utility>

namespace latsch {
namespace {

/// Returns the integral of f from a to b by Simpson's rule.
template <class Function>
double integral(double a, double b, const Function& f) {
  // Number of intervals of Simpson's rule; more are more exact and slower.
  constexpr int kPanels = 400;
  const double h = (b - a) / kPanels;
  double sum = f(a) + f(b);
  for (int k = 1; k < kPanels; ++k) sum += (k % 2 == 1 ? 4.0 : 2.0) * f(a + k * h);
  return sum * h / 3.0;
}

double normal_density(double x) {
  return std::exp(-0.5 * x * x) / std::sqrt(2.0 * std::numbers::pi);
}

/// Returns psi' of Cauchy's loss at z = (x / c)^2.
double cauchy_psi_slope(double z) { return (1.0 - z) / ((1.0 + z) * (1.0 + z)); }

}  // namespace

double RobustLoss::operator()(double x) const {
  if (loss == Loss::squares) return x;
  const double a = std::abs(x) / scale;
  const double rho = loss == Loss::cauchy ? std::log1p(a * a) : a <= 1.0 ? a * a : 2.0 * a - 1.0;
  return std::copysign(scale * std::sqrt(rho), x);
}

double RobustLoss::slope(double x) const {
  const double a = std::abs(x) / scale;
  if (loss == Loss::squares || a == 0.0) return 1.0;
  // The slope is  d sqrt(rho) / da = rho' / (2 sqrt(rho)).
  if (loss == Loss::cauchy) return a / ((1.0 + a * a) * std::sqrt(std::log1p(a * a)));
  return a <= 1.0 ? 1.0 : 1.0 / std::sqrt(2.0 * a - 1.0);
}

LimitedResidual RobustLoss::at(double r) const {
  if (loss == Loss::squares) return {r, 1.0, 1.0, false};
  const double root = std::abs(r) / scale;  // sqrt(rho)
  if (loss == Loss::huber) {
    if (root <= 1.0) return {r, 1.0, 1.0, false};
    return {std::copysign(scale, r), 1.0 / root, 0.0, true};
  }
  const double z = std::expm1(root * root);
  if (!std::isfinite(z)) return {0.0, 0.0, 0.0, true};
  const double slope = z > 0.0 ? std::sqrt(z) / ((1.0 + z) * root) : 1.0;
  return {r * slope, slope, cauchy_psi_slope(z), z > 1.0};
}

GaussianLoss RobustLoss::expected(double sigma) const {
  if (loss == Loss::squares) return {};
  // Standard deviations beyond which the Gaussian density is negligible.
  constexpr double kFar = 9.0;
  const double c = std::min(scale / sigma, kFar);
  const double inside = std::erf(c / std::numbers::sqrt2);
  if (loss == Loss::huber)
    return {1.0 - 2.0 * c * normal_density(c) / inside, inside, 1.0 - inside};
  const double own = scale / sigma;
  const auto square = [own](double x) {
    const double psi = x / (1.0 + x * x / (own * own));
    return psi * psi * normal_density(x);
  };
  const auto slope = [own](double x) {
    return cauchy_psi_slope(x * x / (own * own)) * normal_density(x);
  };
  double mean = 0.0;  // psi' changes most near the corner, so the integral is split there
  for (const auto& [from, to] :
       {std::pair(0.0, c), {c, std::min(10.0 * c, kFar)}, {10.0 * c, kFar}})
    if (from < to) mean += 2.0 * integral(from, to, slope);
  return {2.0 * integral(0.0, c, square) / inside, mean, 1.0 - inside};
}

}  // namespace latsch
