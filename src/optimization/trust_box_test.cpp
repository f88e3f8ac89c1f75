// SPDX-License-Identifier: Apache-2.0
#include "optimization/trust_box.h"

#include <gtest/gtest.h>

#include <cmath>

namespace latsch {
namespace {

constexpr int kResiduals = 40;
constexpr double kRadius = 0.1, kCurvature = 10.0, kRipple = 0.03;

/// Curved by kCurvature in the mean, under a ripple of that height and a length of 0.004.
Eigen::VectorXd residuals(const Eigen::VectorXd& u, double ripple) {
  const double x = u[0] - 0.5, y = u[1] - 0.5;
  Eigen::VectorXd r(kResiduals);
  for (int i = 0; i < kResiduals; ++i) {
    RandomStream random(7, i);
    const double a = random.normal(), b = random.normal();
    const double xx = random.normal(), xy = random.normal(), yy = random.normal();
    r[i] = 1.0 + a * x + b * y + 0.5 * kCurvature * (xx * x * x + 2.0 * xy * x * y + yy * y * y);
    r[i] += ripple *
            std::sin(2.0 * M_PI * (random.uniform() + (x + (0.5 + random.uniform()) * y) / 0.004));
  }
  return r;
}

TrustBox box_with_samples(double ripple) {
  const DesignSpace space({{.name = "x", .initial = 0.5}, {.name = "y", .initial = 0.5}});
  TrustBox box(space, kRadius, 1);
  const auto take = [&](const Eigen::VectorXd& u) {
    const Eigen::VectorXd r = residuals(u, ripple);
    box.take({u, r, {}, r.squaredNorm()});
  };
  const Eigen::VectorXd center = Eigen::VectorXd::Constant(2, 0.5);
  for (int k = 0; k < 12; ++k) {
    RandomStream random(8, k);
    const double x = random.uniform() - 0.5, y = random.uniform() - 0.5;
    take(center + 2.0 * kRadius * Eigen::Vector2d(x, y));
  }
  box.model(/*is_noisy=*/true);
  return box;
}

/// Of the slope along x at the center, by a difference over that length, beside that without
/// ripple.
double error_of_slope(double length) {
  const Eigen::VectorXd u = Eigen::VectorXd::Constant(2, 0.5);
  const Eigen::VectorXd move = length * Eigen::VectorXd::Unit(2, 0);
  const double tiny = 1e-6;
  const Eigen::VectorXd exact =
      (residuals(u + tiny / length * move, 0.0) - residuals(u, 0.0)) / tiny;
  return ((residuals(u + move, kRipple) - residuals(u, kRipple)) / length - exact).norm();
}

TEST(TrustBox, ProbesAreAsLongAsRippleAndCurvatureAsk) {
  const TrustBox box = box_with_samples(kRipple);
  // Least of  2 s^2 / h^2 + (kCurvature h / 2)^2,  s^2 = kRipple^2 / 2 the variance of the ripple.
  const double best = std::pow(8.0 * 0.5 * kRipple * kRipple / (kCurvature * kCurvature), 0.25);
  EXPECT_GT(box.probe_length(), best / 2.5);
  EXPECT_LT(box.probe_length(), best * 2.5);
  EXPECT_LT(error_of_slope(box.probe_length()), 2.0 * error_of_slope(best));
}

TEST(TrustBox, ProbesAreShortWhereThereIsNoRipple) {
  const TrustBox box = box_with_samples(0.0);
  EXPECT_EQ(box.noise, 0.0);
  EXPECT_LT(box.probe_length(), 0.05 * kRadius);
}

}  // namespace
}  // namespace latsch
