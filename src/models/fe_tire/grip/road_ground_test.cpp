// SPDX-License-Identifier: Apache-2.0
#include "models/fe_tire/grip/road_ground.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <numbers>

#include "models/fe_tire/grip/passing_bar.h"
#include "models/road/plane_road.h"
#include "models/road/profile_road.h"
#include "models/road/wave_road.h"

namespace latsch::fe_tire {
namespace {

constexpr double kSmooth = 0.012;  // m
constexpr RoadGround::Size kFelt{.along = 0.1, .across = 0.05, .smooth = kSmooth};

// The bound of the header: a step of the height H is felt within H/1152 of its mean by a hat. A bar
// has two steps, more than 2 w apart.
TEST(RoadGround, FeelsABarAsItsClosedFormSays) {
  constexpr double kHeight = 0.01, kLength = 0.03;
  const road::ProfileRoad road = road::cleat_road(0.0, kHeight, kLength, 0.0);
  const RoadGround ground(road, {}, kFelt);
  const GroundWithBar closed({.height = kHeight, .length = kLength, .smooth = kSmooth});
  const auto felt = ground.below({});
  double most = 0.0;
  for (double x = -0.05; x < 0.05; x += 3.7e-4) {
    const Eigen::Vector2d p(x, 0.013);
    const FeltGround::Place a = felt->at(p), b = closed.at(p);
    most = std::max(most, std::abs(a.height - b.height));
    EXPECT_NEAR(a.height, b.height, kHeight / 1152.0 + 1e-12) << x;
    // The slope is a mean of the hat's, whose three kinks are means over a cell.
    EXPECT_NEAR(a.slope.x(), b.slope.x(), kHeight / kSmooth / 24.0) << x;
    EXPECT_NEAR(a.slope.y(), 0.0, 1e-12);
  }
  EXPECT_GT(most, 0.0);
}

// A hat of half width w leaves 2 (1 - cos kw)/(kw)^2 of a wave of the wave number k. A mean over a
// cell c leaves sin(kc/2)/(kc/2), and so does a cell that has its mean everywhere.
TEST(RoadGround, FeelsTheSharesOfAWaveThatHatAndCellLeave) {
  constexpr double kHigh = 0.004, kWave = 0.05;
  const road::WaveRoad road({.start = -1.0,
                             .end = 1.0,
                             .amplitude_begin = kHigh,
                             .amplitude_end = kHigh,
                             .wave_length_begin = kWave,
                             .wave_length_end = kWave});
  const double k = 2.0 * std::numbers::pi / kWave, kw = k * kSmooth, kc = kw / 12.0;
  const double hat = 2.0 * (1.0 - std::cos(kw)) / (kw * kw),
               cell = std::pow(std::sin(0.5 * kc) / (0.5 * kc), 2);
  const auto felt = RoadGround(road, {}, kFelt).below({});
  for (const double x : {-0.041, -0.0113, 0.0, 0.0271}) {
    const FeltGround::Place place = felt->at({x, 0.0});
    // The cells' own harmonics are beside these shares, of second order in c.
    EXPECT_NEAR(place.height, hat * cell * kHigh * std::sin(k * (x + 1.0)), 2e-3 * kHigh) << x;
    EXPECT_NEAR(place.slope.x(), hat * cell * k * kHigh * std::cos(k * (x + 1.0)), 2e-2 * k * kHigh)
        << x;
  }
}

TEST(RoadGround, HasTheSlopesOfItsHeights) {
  road::ProfileRoad::Settings settings;
  settings.along = road::cleat_profile(0.008, 0.025, 0.002);
  settings.angle = 0.5;
  const road::ProfileRoad road(settings);
  const auto felt = RoadGround(road, {}, kFelt).below({.way = {0.01, -0.02}, .heading = 0.3});
  constexpr double kStep = 1e-7;
  for (const double x : {-0.02, -0.004, 0.003, 0.017}) {
    const Eigen::Vector2d p(x, -0.5 * x);
    const FeltGround::Place place = felt->at(p);
    for (int k = 0; k < 2; ++k) {
      const Eigen::Vector2d moved = kStep * Eigen::Vector2d::Unit(k);
      EXPECT_NEAR(place.slope[k],
                  (felt->at(p + moved).height - felt->at(p - moved).height) / (2.0 * kStep),
                  1e-5);
    }
  }
}

// A wheel that travels sees one ground, whatever cells are around it, and a flank that travels with
// a belt changes heights evenly.
TEST(RoadGround, DoesNotChangeWithTheWheelOrJumpWithABelt) {
  road::ProfileRoad::Settings settings;
  settings.along = road::cleat_profile(0.01, 0.02, 0.0);
  const road::ProfileRoad still(settings);
  const RoadGround ground(still, {}, kFelt);
  const auto here = ground.below({}), there = ground.below({.way = {0.0137, 0.0041}});
  for (const double x : {-0.01, 0.002, 0.011})
    EXPECT_NEAR(here->at({x, 0.0}).height, there->at({x, 0.0}).height, 1e-15);
  settings.belt = 1.0;
  const road::ProfileRoad moving(settings);
  const RoadGround belt(moving, {}, kFelt);
  constexpr double kStep = 1e-5;  // s, 0.01 mm of the belt
  double before = belt.below({})->at({0.0, 0.0}).height, jump = 0.0;
  for (int k = 1; k < 600; ++k) {
    const double now = belt.below({.time = k * kStep})->at({0.0, 0.0}).height;
    jump = std::max(jump, std::abs(now - before));
    before = now;
  }
  EXPECT_LT(jump, 1.01 * 0.01 / kSmooth * 1e-5);
}

TEST(RoadGround, OnAPlaneOfItsOwnIsLevel) {
  const road::PlaneRoad road({.height = 0.3, .grade = 0.1, .bank = -0.05});
  const Eigen::Vector3d at(2.0, 1.0, road.height(2.0, 1.0, 0.0));
  const ReferencePlane plane = ReferencePlane::through(at, road.at(at.x(), at.y(), 0.0).normal);
  const auto felt = RoadGround(road, plane, kFelt).below({.way = {0.4, -0.2}});
  const FeltGround::Place place = felt->at({0.45, -0.17});
  EXPECT_NEAR(place.height, 0.0, 1e-14);
  EXPECT_LT(place.slope.norm(), 1e-14);
  // Over a level plane it has its own slopes.
  const auto over_level =
      RoadGround(road, ReferencePlane::through(at, Eigen::Vector3d::UnitZ()), kFelt).below({});
  EXPECT_NEAR(over_level->at({0.05, 0.02}).height, 0.1 * 0.05 - 0.05 * 0.02, 1e-14);
  EXPECT_NEAR(over_level->at({0.05, 0.02}).slope.x(), 0.1, 1e-14);
}

}  // namespace
}  // namespace latsch::fe_tire
