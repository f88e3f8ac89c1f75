// SPDX-License-Identifier: Apache-2.0
#include "models/fe_tire/description/contour.h"

#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

namespace latsch::fe_tire {
namespace {

/// Returns the meridian of a torus: n + 1 points on a half circle of radius a, whose center is at
/// the radius R.
Contour circle(double a, double R, int n) {
  std::vector<MeridianPoint> half;
  for (int i = 0; i <= n; ++i) {
    const double phi = 0.5 * std::numbers::pi * i / n;
    half.push_back({a * std::sin(phi), R + a * std::cos(phi)});
  }
  return Contour(half);
}

TEST(Contour, StraightLineIsExact) {
  const Contour line({{0.0, 0.3}, {0.05, 0.3}, {0.12, 0.3}});
  EXPECT_NEAR(line.length(), 0.24, 1e-15);
  EXPECT_NEAR(line.point(-0.5).y, 0.06, 1e-12);
  EXPECT_NEAR(line.offset(0.5, 0.01).r, 0.31, 1e-15);
  EXPECT_NEAR(line.tangent(0.0).y, -1.0, 1e-15);
}

// A natural spline has no curvature at its ends, so it deviates from a curved end by O(h^2). Twice
// as many points on a circle must reduce the error of the length to a quarter or less.
TEST(Contour, LengthOfACircleConvergesWithTheSquareOfThePointDistance) {
  const double exact = 0.1 * std::numbers::pi;
  const double coarse = std::abs(circle(0.1, 0.3, 4).length() - exact);
  const double fine = std::abs(circle(0.1, 0.3, 8).length() - exact);
  EXPECT_LT(fine, coarse / 4.0);
  EXPECT_LT(fine, 1e-4 * exact);
}

TEST(Contour, OffsetIsNormalToTheTangentAndOutward) {
  const Contour line = circle(0.1, 0.3, 16);
  for (double s : {-0.7, -0.2, 0.0, 0.4, 0.9}) {
    const MeridianPoint p = line.point(s), o = line.offset(s, 0.01), t = line.tangent(s);
    EXPECT_NEAR((o.y - p.y) * t.y + (o.r - p.r) * t.r, 0.0, 1e-15);
    EXPECT_NEAR(std::hypot(o.y, o.r - 0.3), 0.11, 2e-4);
  }
}

}  // namespace
}  // namespace latsch::fe_tire
