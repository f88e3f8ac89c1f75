// SPDX-License-Identifier: Apache-2.0
#include "models/fe_tire/grip/passing_bar.h"

#include <gtest/gtest.h>

#include <cmath>

#include "models/fe_tire/grip/rolling_surface.h"

namespace latsch::fe_tire {
namespace {

/// Height of the bar's own section, m.
double section(const PassingBar::Size& of, double s) {
  const double inside = 0.5 * of.length - std::abs(s);
  if (inside < 0.0) return 0.0;
  return inside < of.bevel ? of.height - (of.bevel - inside) : of.height;
}

TEST(PassingBar, IsTheMeanOfItsSectionByAHat) {
  const PassingBar::Size size{.height = 0.01, .length = 0.025, .bevel = 0.004, .smooth = 0.011};
  const PassingBar bar(size);
  constexpr int kPieces = 200000;
  for (const double s : {-0.022, -0.012, -0.004, 0.0, 0.009, 0.0171}) {
    double mean = 0.0;
    for (int k = 0; k < kPieces; ++k) {
      const double r = size.smooth * (2.0 * (k + 0.5) / kPieces - 1.0);
      mean += (1.0 - std::abs(r) / size.smooth) * section(size, s + r) * 2.0 / kPieces;
    }
    EXPECT_NEAR(bar.at(s).height, mean, 1e-7) << s;
    const double step = 1e-6;
    EXPECT_NEAR(
        bar.at(s).slope, (bar.at(s + step).height - bar.at(s - step).height) / (2.0 * step), 1e-4)
        << s;
  }
}

TEST(PassingBar, IsLevelBeyondItsReach) {
  const PassingBar bar({.height = 0.01, .length = 0.02, .smooth = 0.01});
  EXPECT_DOUBLE_EQ(bar.reach(), 0.02);
  for (const double s : {-0.021, 0.021}) {
    EXPECT_EQ(bar.at(s).height, 0.0);
    EXPECT_EQ(bar.at(s).slope, 0.0);
  }
  EXPECT_EQ(bar.at(-0.03).longer, 0.0);
}

TEST(PassingBar, KnowsTheLengthOfItsArc) {
  const PassingBar bar({.height = 0.01, .length = 0.02, .smooth = 0.01});
  double length = 0.0;
  constexpr double kStep = 1e-5;
  for (double s = -bar.reach(); s < bar.reach(); s += kStep)
    length += std::hypot(kStep, bar.at(s + kStep).height - bar.at(s).height) - kStep;
  EXPECT_NEAR(bar.at(0.03).longer, length, 1e-6);
  for (const double s : {-0.018, -0.01, 0.0, 0.013, 0.05})
    EXPECT_NEAR(bar.across(s + bar.at(s).longer), s, 1e-12);
}

/// A surface at 8 m/s straight ahead with a bar 30 mm ahead of the wheel center.
class SurfaceWithBar : public testing::TestWithParam<double> {
 protected:
  SurfaceWithBar()
      : ground_({.height = kHigh, .length = 0.02, .angle = 0.4, .smooth = 0.01}),
        surface_(GetParam(), {1.0, 0.0}) {
    surface_.set_ground(ground_, {.way = {-0.03, 0.0}});
  }
  static constexpr double kHigh = 0.008;  // m
  GroundWithBar ground_;
  RollingSurface surface_;
};

TEST_P(SurfaceWithBar, FindsTheGroundBelowAPlace) {
  for (const double x : {-0.02, 0.01, 0.02, 0.028, 0.035, 0.06}) {
    const Eigen::Vector2d rolled(x, -0.013);
    const Eigen::Vector3d ground = surface_.point(rolled);
    const RollingSurface::Place place = surface_.place(ground);
    EXPECT_NEAR(place.x.z(), 0.0, 1e-12) << x;
    EXPECT_LT((place.x.head<2>() - rolled).norm(), 1e-9) << x;
  }
}

TEST_P(SurfaceWithBar, TurnsMotionsAsPlacesMove) {
  const double step = 1e-7, round = GetParam() * kHigh;
  for (const double x : {0.012, 0.019, 0.027, 0.04}) {
    const Eigen::Vector3d q = surface_.point({x, 0.004});  // on the ground
    const RollingSurface::Place at = surface_.place(q);
    EXPECT_LT((at.turn * at.turn.transpose() - Eigen::Matrix3d::Identity()).norm(), 1e-12);
    for (int k = 0; k < 3; ++k) {
      const Eigen::Vector3d moved = step * Eigen::Vector3d::Unit(k);
      const Eigen::Vector3d slope =
          (surface_.place(q + moved).x - surface_.place(q - moved).x) / (2.0 * step);
      // On a drum slopes are too steep by the height over the radius, which is left out.
      EXPECT_NEAR(slope.z(), at.turn(2, k), 1e-4 + round) << x << " " << k;
    }
    // Along the slope a place moves by the arc.
    const Eigen::Vector3d along = at.turn.row(0).transpose();
    const Eigen::Vector3d slope =
        (surface_.place(q + step * along).x - surface_.place(q - step * along).x) / (2.0 * step);
    EXPECT_NEAR(slope.x(), 1.0, 2e-3 + round) << x;
  }
}

// The heading of the wheel turns the bar below it: a bar at an angle is one across the way below a
// wheel that heads to the other side.
TEST(GroundWithBar, IsTurnedByTheHeadingOfTheWheel) {
  const PassingBar::Size straight{.height = 0.008, .length = 0.02, .smooth = 0.01};
  PassingBar::Size oblique = straight;
  oblique.angle = 0.4;
  const GroundWithBar one(straight), other(oblique);
  RollingSurface turned(0.0, {1.0, 0.0}), ahead(0.0, {1.0, 0.0});
  turned.set_ground(one, {.heading = -0.4});
  ahead.set_ground(other, {});
  for (const double x : {-0.017, -0.004, 0.012}) {
    const Eigen::Vector3d q(x, 0.007, 0.02);
    const RollingSurface::Place a = turned.place(q), b = ahead.place(q);
    EXPECT_LT((a.x - b.x).norm(), 1e-15);
    EXPECT_LT((a.turn - b.turn).norm(), 1e-12);
  }
}

INSTANTIATE_TEST_SUITE_P(FlatAndDrum, SurfaceWithBar, testing::Values(0.0, 0.8));

}  // namespace
}  // namespace latsch::fe_tire
