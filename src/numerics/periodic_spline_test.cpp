// SPDX-License-Identifier: Apache-2.0
#include "numerics/periodic_spline.h"

#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

namespace latsch::numerics {
namespace {

constexpr double kTurn = 2.0 * std::numbers::pi;

/// Places of unequal distance, their widths varying by a factor of three.
std::vector<double> unequal_places(int n) {
  std::vector<double> t(n);
  for (int k = 0; k < n; ++k) {
    const double share = kTurn * k / n;
    t[k] = share + 0.5 * std::sin(share) + 0.3;
  }
  return t;
}

PeriodicSpline through_waves(const std::vector<double>& t) {
  Eigen::MatrixXd y(2, std::ssize(t));
  for (std::size_t k = 0; k < t.size(); ++k)
    y.col(static_cast<Eigen::Index>(k)) << std::sin(3 * t[k]), std::cos(2 * t[k]);
  return {t, kTurn, y};
}

TEST(PeriodicSpline, PassesThroughItsPointsInEveryPeriod) {
  const std::vector<double> t = unequal_places(20);
  const PeriodicSpline spline = through_waves(t);
  for (const double place : t) {
    for (const int turn : {-1, 0, 2})
      EXPECT_NEAR(spline.at(place + turn * kTurn).value[0], std::sin(3 * place), 1e-12);
  }
}

TEST(PeriodicSpline, DerivativesAreContinuousAcrossAllPoints) {
  const std::vector<double> t = unequal_places(12);
  const PeriodicSpline spline = through_waves(t);
  for (const double place : t) {
    const auto before = spline.at(place - 1e-9), after = spline.at(place + 1e-9);
    EXPECT_LT((before.first - after.first).norm(), 1e-6);
    EXPECT_LT((before.second - after.second).norm(), 1e-6);
  }
}

TEST(PeriodicSpline, ErrorsFallWithTheFourthThirdAndSecondPower) {
  double before[3] = {};
  for (const int n : {80, 160}) {
    const PeriodicSpline spline = through_waves(unequal_places(n));
    double errors[3] = {};
    for (double t = 0.0; t < kTurn; t += 0.003) {
      const auto at = spline.at(t);
      errors[0] = std::max(errors[0], std::abs(at.value[0] - std::sin(3 * t)));
      errors[1] = std::max(errors[1], std::abs(at.first[0] - 3 * std::cos(3 * t)));
      errors[2] = std::max(errors[2], std::abs(at.second[0] + 9 * std::sin(3 * t)));
    }
    for (int k = 0; k < 3; ++k) {
      if (before[k] > 0.0) {
        EXPECT_NEAR(std::log2(before[k] / errors[k]), 4.0 - k, 0.25) << k;
      }
      before[k] = errors[k];
    }
  }
}

}  // namespace
}  // namespace latsch::numerics
