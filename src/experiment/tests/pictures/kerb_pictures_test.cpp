// SPDX-License-Identifier: Apache-2.0
#include "experiment/tests/pictures/kerb_pictures.h"

#include <gtest/gtest.h>

#include <cmath>

#include "experiment/rigs/car/kerb_rig.h"

namespace latsch::experiment {
namespace {

// r = R + Σ a_n cos(nφ - ψ_n) has c_n = a_n/2 e^(-iψ_n). The points deviate from even spacing, as
// nodes of a belt do; the trapezoidal rule on uneven points is of second order.
TEST(KerbFilm, FindsTheWavesACurveIsMadeOf) {
  const std::array<double, 6> a = {0.0, 2e-3, 1e-3, 3e-3, 5e-4, 7e-4};
  std::vector<Eigen::Vector2d> points;
  constexpr int kPoints = 120;
  for (int k = 0; k < kPoints; ++k) {
    const double u = 2.0 * M_PI * k / kPoints, phi = u + 0.02 * std::sin(2.0 * u);
    double r = 0.23;
    for (int n = 1; n < 6; ++n) r += a[static_cast<std::size_t>(n)] * std::cos(n * phi - 0.3 * n);
    points.emplace_back(r * std::cos(phi), r * std::sin(phi));
  }
  const auto c = KerbFilm::waves(points);
  EXPECT_NEAR(c[0].real(), 0.23, 1e-5);
  for (std::size_t n = 1; n < 6; ++n) {
    EXPECT_NEAR(2.0 * std::abs(c[n]), a[n], 2e-5) << n;
    EXPECT_NEAR(std::arg(c[n]), -0.3 * static_cast<double>(n), 0.03) << n;
  }
}

// Three sines of amplitude sqrt(2/3) have together the variance 1; over a hundred periods mean and
// deviation are the prescribed ones.
TEST(Wander, HasTheDeviationAskedFor) {
  const History speed = wandering(60.0, 0.5, {.period = 0.5, .seed = 3}, 1, 0.0, 50.0);
  double mean = 0.0, square = 0.0;
  const auto count = static_cast<double>(speed.values.size());
  for (const double value : speed.values) mean += value / count;
  for (const double value : speed.values) square += (value - mean) * (value - mean) / count;
  EXPECT_NEAR(mean, 60.0, 0.01);
  EXPECT_NEAR(std::sqrt(square), 0.5, 0.01);
  EXPECT_NEAR(speed.mean(0.0, 50.0), 60.0, 0.01);
}

}  // namespace
}  // namespace latsch::experiment
