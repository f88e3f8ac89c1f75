// SPDX-License-Identifier: Apache-2.0
#include "experiment/rigs/followed_state.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <vector>

namespace latsch::experiment {
namespace {

/// A damped oscillator x'' = -omega^2 x - 2 D omega x', its rate told only where it was taken to:
/// x after each of `parts` steps.
std::vector<double> oscillation(double time, int parts, double omega, double damping) {
  FollowedState x(1.0), v(0.0);
  const double h = time / parts;
  x.start(0.0);
  v.start(-omega * omega);
  std::vector<double> way;
  for (int i = 0; i < parts; ++i) {
    const double x1 = x.predicted(h), v1 = v.predicted(h);
    x.correct(h, v1);
    v.correct(h, -omega * omega * x1 - 2.0 * damping * omega * v1);
    way.push_back(x.value());
  }
  return way;
}

double worst_error(int parts) {
  constexpr double omega = 200.0, D = 0.1, time = 0.05;
  const double ringing = omega * std::sqrt(1.0 - D * D);
  const std::vector<double> way = oscillation(time, parts, omega, D);
  double worst = 0.0;
  for (int i = 0; i < parts; ++i) {
    const double t = time * (i + 1) / parts;
    const double exact = std::exp(-D * omega * t) *
                         (std::cos(ringing * t) + D * omega / ringing * std::sin(ringing * t));
    worst = std::max(worst, std::abs(way[static_cast<std::size_t>(i)] - exact));
  }
  return worst;
}

TEST(FollowedState, IsOfOrderTwo) {
  for (const int parts : {200, 400, 800})
    EXPECT_NEAR(std::log2(worst_error(parts) / worst_error(2 * parts)), 2.0, 0.15) << parts;
}

// Without damping nothing grows up to h omega = 0.6: that of kLongestStep and 95 Hz.
TEST(FollowedState, KeepsAnUndampedWheelFromGrowing) {
  for (const double angle : {0.1, 0.3, 0.597}) {
    constexpr int kSteps = 10000;
    const std::vector<double> way = oscillation(angle * kSteps, kSteps, 1.0, 0.0);
    EXPECT_LT(*std::max_element(way.end() - 100, way.end()), 1.0) << angle;
  }
  EXPECT_LT(2.0 * M_PI * 95.0 * kLongestStep, 0.6);
}

}  // namespace
}  // namespace latsch::experiment
