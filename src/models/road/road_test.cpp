// SPDX-License-Identifier: Apache-2.0
// Tests roads of every kind against the geometry from which they are made.
#include <gtest/gtest.h>

#include <Eigen/Geometry>
#include <cmath>
#include <numbers>

#include "base/random.h"
#include "models/road/crg_road.h"
#include "models/road/drum_road.h"
#include "models/road/kerb.h"
#include "models/road/placed_road.h"
#include "models/road/plane_road.h"
#include "models/road/profile_road.h"
#include "models/road/triangle_road.h"
#include "models/road/wave_road.h"

namespace latsch::road {
namespace {

// Rounding error of coordinates of a few meters, m.
constexpr double kRounding = 1e-14;

/// Expects the normal to agree with central differences of the height with step h. Their error is
/// h² times a third derivative (below 1/m² here), plus the rounding of the height divided by h.
void expect_normal_of_surface(const Road& road, double x, double y, double time) {
  constexpr double h = 1e-5;
  constexpr double kError = 1e-8;
  const GroundPoint ground = road.at(x, y, time);
  EXPECT_EQ(ground.height, road.height(x, y, time));
  const double slope_x = (road.height(x + h, y, time) - road.height(x - h, y, time)) / (2.0 * h);
  const double slope_y = (road.height(x, y + h, time) - road.height(x, y - h, time)) / (2.0 * h);
  const Eigen::Vector3d normal = Eigen::Vector3d(-slope_x, -slope_y, 1.0).normalized();
  EXPECT_LT((ground.normal - normal).norm(), kError) << "x " << x << " y " << y;
}

TEST(PlaneRoad, IsLevelOrOfTheGradeAskedForAndItsBeltRunsAlongIt) {
  EXPECT_EQ(PlaneRoad().at(3.0, -2.0, 1.0).height, 0.0);
  PlaneRoad::Settings settings;
  settings.height = 0.1;
  settings.grade = 0.02;
  settings.bank = -0.01;
  settings.belt = Travel(20.0);
  const PlaneRoad road(settings);
  EXPECT_NEAR(road.height(5.0, 2.0, 0.0), 0.1 + 0.1 - 0.02, kRounding);
  expect_normal_of_surface(road, 5.0, 2.0, 0.0);
  const GroundPoint ground = road.at(5.0, 2.0, 0.0);
  EXPECT_NEAR(ground.velocity.norm(), 20.0, kRounding * 20);
  EXPECT_NEAR(ground.velocity.dot(ground.normal), 0.0, 20 * kRounding);
  EXPECT_LT(ground.velocity.x(), 0.0);
}

TEST(Travel, IsTheIntegralOfItsSpeed) {
  const Travel ramp({{1.0, 0.0}, {3.0, 10.0}});  // 5 m/s² from 1 s to 3 s
  EXPECT_EQ(ramp.distance(0.0), 0.0);
  EXPECT_NEAR(ramp.distance(2.0), 2.5, kRounding);
  EXPECT_NEAR(ramp.distance(3.0), 10.0, kRounding);
  EXPECT_NEAR(ramp.distance(5.0), 30.0, kRounding);
  EXPECT_EQ(ramp.speed(0.5), 0.0);
  EXPECT_EQ(ramp.speed(2.0), 5.0);
  EXPECT_EQ(ramp.speed(9.0), 10.0);
  EXPECT_NEAR(Travel(-3.0).distance(2.0), -6.0, kRounding);
}

TEST(Profile, OfACleatHasItsBevelAndTheHigherSideOfAFlank) {
  const Profile cleat = cleat_profile(0.020, 0.050, 0.005);
  EXPECT_EQ(cleat.at(0.0).height, 0.020);
  EXPECT_EQ(cleat.at(-0.025).height, 0.015);
  EXPECT_EQ(cleat.at(-0.0251).height, 0.0);
  EXPECT_NEAR(cleat.at(0.0225).height, 0.0175, kRounding);
  EXPECT_NEAR(cleat.at(0.0225).slope, -1.0, 1e-12);  // 45 deg
  const Profile groove = cleat_profile(-0.020, 0.050, 0.005);
  EXPECT_NEAR(groove.at(-0.0225).height, -0.0025, kRounding);
  EXPECT_EQ(groove.at(0.0).height, -0.020);
  // On a vertical flank the height is that of its upper edge.
  EXPECT_EQ(groove.at(-0.020).height, -0.005);
}

TEST(Profile, PointsAsGoodAsAboveEachOtherAreAFlank) {
  const Profile profile({{0.0, 0.0}, {1e-320, 1.0}, {1.0, 1.0}});
  EXPECT_EQ(profile.at(0.0).height, 1.0);
  EXPECT_EQ(profile.at(0.0).slope, 0.0);
  EXPECT_EQ(profile.at(1e-321).height, 1.0);
  const Profile spike = rounded_profile({{0.0, 0.0}, {0.0, 1.0}, {0.0, 0.0}}, {0.0, 0.1, 0.0});
  EXPECT_EQ(spike.at(0.0).height, 1.0);
}

TEST(CleatRoad, TurnsWithItsAngleAndTravelsWithItsBelt) {
  constexpr double angle = 0.4;
  const ProfileRoad road = cleat_road(2.0, 0.02, 0.05, 0.005, angle);
  const Eigen::Vector2d along(std::cos(angle), std::sin(angle)), left(-along.y(), along.x());
  const Eigen::Vector2d top = Eigen::Vector2d(2.0, 0.0) + 0.7 * left;
  EXPECT_NEAR(road.height(top.x(), top.y(), 0.0), 0.02, kRounding);
  const Eigen::Vector2d bevel = top + 0.0225 * along;
  EXPECT_NEAR(road.height(bevel.x(), bevel.y(), 0.0), 0.0175, kRounding);
  expect_normal_of_surface(road, bevel.x(), bevel.y(), 0.0);

  ProfileRoad::Settings settings;
  settings.along = cleat_profile(0.02, 0.05, 0.005);
  settings.origin.x() = 2.0;
  settings.belt = Travel(10.0);
  const ProfileRoad belt(settings);
  EXPECT_EQ(belt.height(0.0, 0.0, 0.2), 0.02);
  EXPECT_EQ(belt.height(2.0, 0.0, 0.2), 0.0);
  EXPECT_EQ(belt.at(0.0, 0.0, 0.2).velocity.x(), -10.0);
}

TEST(KerbRoad, RepeatsItsSectionAndEnds) {
  Kerb kerb;  // the kerb of the saw-tooth sample: four repetitions of 800 x 800 x 25 mm
  kerb.height = 0.025;
  kerb.start = {0.0, -0.4};
  kerb.friction = 0.9;
  const ProfileRoad road = kerb_road(kerb);
  EXPECT_NEAR(road.height(0.4, 0.0, 0.0), 0.0125, kRounding);
  EXPECT_NEAR(road.height(0.4 + 3 * 0.8, 0.39, 0.0), 0.0125, kRounding);
  EXPECT_EQ(road.height(0.4 + 4 * 0.8, 0.0, 0.0), 0.0);
  EXPECT_EQ(road.height(-0.1, 0.0, 0.0), 0.0);
  EXPECT_EQ(road.height(0.4, 0.41, 0.0), 0.0);
  EXPECT_EQ(road.at(0.4, 0.0, 0.0).friction, 0.9);
  EXPECT_EQ(road.at(0.4, 0.5, 0.0).friction, 1.0);
  expect_normal_of_surface(road, 0.4, 0.0, 0.0);

  kerb.shape = Kerb::Shape::sine;
  kerb.height = -0.025;
  const ProfileRoad wave = kerb_road(kerb);
  for (double x = 0.0; x < 3.2; x += 0.0501) {
    const double exact = -0.0125 * (1.0 - std::cos(2.0 * std::numbers::pi * x / 0.8));
    EXPECT_NEAR(wave.height(x, 0.0, 0.0), exact, 4e-5 * 0.025);
  }
  kerb.shape = Kerb::Shape::triangle;
  kerb.ramp = 0.3;
  const ProfileRoad ramped = kerb_road(kerb);
  EXPECT_NEAR(ramped.height(0.4, -0.25, 0.0), -0.0125, kRounding);
  expect_normal_of_surface(ramped, 0.3, -0.25, 0.0);
}

class Drum : public ::testing::TestWithParam<bool> {
 protected:
  DrumRoad::Settings settings(double speed = 0.0) const {
    DrumRoad::Settings settings;
    settings.diameter = 2.5;
    settings.inner = GetParam();
    settings.surface = Travel(speed);
    return settings;
  }
};

TEST_P(Drum, SurfaceIsACircleThroughTheOriginAndTurnsAsARigidBody) {
  const DrumRoad road(settings(30.0));
  const double axis = GetParam() ? 1.25 : -1.25;
  for (const double x : {-1.1, -0.3, 1e-5, 0.2, 1.18}) {
    const GroundPoint ground = road.at(x, 0.3, 0.0);
    EXPECT_NEAR(std::hypot(x, ground.height - axis), 1.25, 4 * kRounding);
    EXPECT_EQ(std::signbit(ground.height), !GetParam());
    expect_normal_of_surface(road, x, 0.3, 0.0);
    EXPECT_NEAR(ground.velocity.norm(), 30.0, 100 * kRounding);
    EXPECT_NEAR(ground.velocity.dot(ground.normal), 0.0, 100 * kRounding);
    EXPECT_LT(ground.velocity.x(), 0.0);
  }
  expect_normal_of_surface(road, 1.3, 0.0, 0.0);  // at x = 1.3 m the tangent replaces the drum
  EXPECT_NEAR(road.height(0.95 * 1.25, 0, 0), road.height(0.95 * 1.25 + 1e-12, 0, 0), 1e-11);
}

TEST_P(Drum, CleatPassesTheTopOnceATurn) {
  DrumRoad::Settings with = settings(20.0);
  with.cleats = {{cleat_profile(0.02, 0.025, 0.005), 0.5, 0.0, 0.8}};
  const DrumRoad road(with);
  const double first = 0.5 * 1.25 / 20.0;  // time in which the drum turns by 0.5 rad, to the cleat
  const double period = 2.0 * std::numbers::pi * 1.25 / 20.0;
  // The top of the cleat is a straight chord between corners at 7.5 mm of arc from its middle, so
  // its middle is nearer to the axis than its corners.
  const double sag = (GetParam() ? 1.23 : 1.27) * (1.0 - std::cos(0.0075 / 1.25));
  for (int turn = 0; turn < 3; ++turn) {
    const GroundPoint ground = road.at(0.0, 0.0, first + turn * period);
    EXPECT_NEAR(ground.height, GetParam() ? 0.02 + sag : 0.02 - sag, 1e-13);
    EXPECT_EQ(ground.friction, 0.8);
    EXPECT_EQ(road.height(0.0, 0.0, first + (turn + 0.5) * period), 0.0);
  }
  // Just before the cleat reaches the top, its leading bevel is at x > 0.
  const double drum = DrumRoad(settings()).height(0.03, 0.0, 0.0);
  EXPECT_NEAR(road.height(0.03, 0.0, first - 0.03 / 20.0) - drum, 0.02, 1e-4);
  EXPECT_EQ(road.height(0.0, 0.0, first - 0.03 / 20.0), 0.0);
}

TEST_P(Drum, InclinedCleatIsASlopeWithTheRightNormalAndComesEarlierToTheLeft) {
  DrumRoad::Settings with = settings(0.0);
  const double angle = 0.3;
  with.cleats = {{cleat_profile(0.03, 0.08, 0.03), 0.2, angle, 1.0}};
  const DrumRoad road(with);
  for (const double y : {-0.2, 0.0, 0.15}) {
    const double theta = 0.2 - y * std::tan(angle) / 1.25;
    const double middle = std::sin(theta) * (GetParam() ? 1.22 : 1.28);
    EXPECT_NEAR(road.height(middle, y, 0.0) - DrumRoad(settings()).height(middle, y, 0.0),
                0.03 / std::cos(theta),
                1e-3);  // the error is of first order in height / R
    for (const double aside : {-0.031, -0.023, 0.021, 0.029}) {
      expect_normal_of_surface(road, middle + aside, y, 0.0);
    }
  }
}

TEST_P(Drum, FindsACleatThatLeansOverItsFoot) {
  // A high cleat sticks out of the drum by its height wherever its top is visible from above, even
  // where its foot is hidden.
  DrumRoad::Settings with = settings(0.0);
  for (const double theta : {-1.1, -0.7, 0.9}) {
    with.cleats = {{cleat_profile(0.06, 0.1, 0.0), theta, 0.0, 1.0}};
    const DrumRoad road(with);
    const double r = GetParam() ? 1.19 : 1.31;
    const double x = r * std::sin(theta);
    const double z = GetParam() ? 1.25 - r * std::cos(theta) : -1.25 + r * std::cos(theta);
    if (std::abs(x) > 0.95 * 1.25) continue;
    EXPECT_NEAR(road.height(x, 0.0, 0.0), z, 0.1 * 0.1 / (8.0 * 1.19) / std::cos(theta));
  }
}

INSTANTIATE_TEST_SUITE_P(Both, Drum, ::testing::Bool(), [](const auto& kind) {
  return kind.param ? "Inner" : "Outer";
});

TEST(DrumRoad, SpacesCleatsEqually) {
  DrumRoad::Settings settings;
  settings.diameter = 2.0;
  settings.cleats = equally_spaced(4, {cleat_profile(0.01, 0.02, 0.0), 0.1, 0.0, 1.0});
  settings.surface = Travel(1.0);
  const DrumRoad road(settings);
  for (int i = 0; i < 4; ++i) {
    EXPECT_GT(road.height(0.0, 0.0, 0.1 + i * std::numbers::pi / 2.0), 0.0099);
    EXPECT_EQ(road.height(0.0, 0.0, 0.2 + i * std::numbers::pi / 2.0), 0.0);
  }
}

/// Returns a mesh of 8 x 8 squares over x, y = -0.5 ... 0.5 m, each divided into two triangles,
/// with a hole in the middle.
TriangleMesh hilly_mesh(double height) {
  constexpr int kSquares = 8;
  RandomStream random(5, 1);
  TriangleMesh mesh;
  for (int j = 0; j <= kSquares; ++j)
    for (int i = 0; i <= kSquares; ++i)
      mesh.nodes.emplace_back(
          double(i) / kSquares - 0.5, double(j) / kSquares - 0.5, height * random.uniform());
  for (int j = 0; j < kSquares; ++j)
    for (int i = 0; i < kSquares; ++i) {
      if (i == 4 && j == 4) continue;
      const int a = j * (kSquares + 1) + i, b = a + kSquares + 1;
      mesh.triangles.push_back({{a, a + 1, b}, 1.0});
      mesh.triangles.push_back({{a + 1, b + 1, b}, 1.0});
    }
  return mesh;
}

CrgGrid banked_grid() {
  RandomStream random(6, 1);
  CrgGrid grid;
  grid.u_increment = 0.1;
  grid.v = {-0.3, -0.1, 0.05, 0.4};
  for (int row = 0; row < 12; ++row) {
    grid.line.emplace_back(-0.55 + 0.1 * row, 0.02);
    grid.line_height.push_back(0.01 * random.uniform());
    grid.banking.push_back(0.1 * (random.uniform() - 0.5));
    for (int c = 0; c < 4; ++c) grid.z.push_back(0.02 * random.uniform());
  }
  return grid;
}

// A triangle mesh ends at its outline and at its hole, a grid at its borders, and a placed road at
// the transformed borders. Kerbs, drums and planes are infinite.
TEST(Road, EndsWhereItsDataDo) {
  const auto mesh = std::make_shared<const TriangleRoad>(hilly_mesh(0.01));
  EXPECT_EQ(mesh->beyond(-0.4, 0.49), "");
  EXPECT_EQ(mesh->beyond(0.5, 0.5), "");  // the border belongs to the road
  EXPECT_NE(mesh->beyond(0.51, 0.0).find("y = -0.5 and 0.5 m"), std::string::npos);
  EXPECT_NE(mesh->beyond(0.06, 0.06), "");  // this point is in the hole
  const PlacedRoad placed(mesh, std::numbers::pi / 2.0, {10.0, 0.0, 1.0});
  EXPECT_EQ(placed.beyond(10.0 - 0.4, -0.4), "");
  EXPECT_NE(placed.beyond(0.0, 0.0), "");

  CrgGrid grid = banked_grid();
  EXPECT_EQ(CrgRoad(grid).beyond(0.0, 0.3), "");
  EXPECT_NE(CrgRoad(grid).beyond(0.0, 0.43).find("v = -0.3 to 0.4 m"), std::string::npos);
  EXPECT_NE(CrgRoad(grid).beyond(0.6, 0.0), "");
  grid.border_u = CrgGrid::Border::repeat;
  EXPECT_EQ(CrgRoad(grid).beyond(0.6, 0.0), "");
  EXPECT_NE(CrgRoad(grid).beyond(0.6, 0.43), "");
  EXPECT_EQ(PlaneRoad{}.beyond(1e6, -1e6), "");
}

// Bounds that a road returns for a rectangle must hold at every point of it.
TEST(Road, BoundsHoldInTheWholeBox) {
  const DrumRoad drum({.diameter = 2.0,
                       .surface = 3.0,
                       .cleats = {{.profile = cleat_profile(0.02, 0.03, 0.005), .angle = 0.6}}});
  const DrumRoad inner({.diameter = 3.0,
                        .inner = true,
                        .surface = 3.0,
                        .cleats = {{.profile = cleat_profile(0.02, 0.03, 0.005), .angle = -0.3}}});
  const DrumRoad straight(
      {.diameter = 2.0, .cleats = {{.profile = cleat_profile(0.02, 0.03, 0.005)}}});
  Kerb saw{.pitch = 0.1, .width = 0.2, .height = 0.02, .count = 3, .ramp = 0.05};
  const ProfileRoad kerb = kerb_road(saw);
  const ProfileRoad cleat = cleat_road(0.3, 0.02, 0.03, 0.005, 0.5);
  const ProfileRoad row({.along = cleat_profile(0.02, 0.03, 0.005), .pitch = 0.2, .belt = 2.0});
  const PlaneRoad plane({.grade = 0.1, .bank = -0.05});
  const WaveRoad wave({.start = -0.1,
                       .end = 0.25,
                       .amplitude_begin = 0.02,
                       .amplitude_end = -0.005,
                       .wave_length_begin = 0.1,
                       .wave_length_end = 0.05});
  const PlacedRoad placed(
      std::make_unique<ProfileRoad>(cleat_road(0.1, 0.02, 0.03, 0.005, 0.5)), 0.7, {0.1, 0.0, 0.3});
  const TriangleRoad level(hilly_mesh(0.0)), hills(hilly_mesh(0.01));
  const CrgRoad grid(banked_grid());
  RandomStream random(3, 1);
  int planes = 0, cylinders = 0;
  for (const Road* road : std::initializer_list<const Road*>{&drum,
                                                             &inner,
                                                             &straight,
                                                             &kerb,
                                                             &cleat,
                                                             &row,
                                                             &plane,
                                                             &wave,
                                                             &placed,
                                                             &level,
                                                             &hills,
                                                             &grid})
    for (int i = 0; i < 400; ++i) {
      const double x = 0.8 * (random.uniform() - 0.5), y = 0.4 * (random.uniform() - 0.5);
      const double a = 0.1 * random.uniform(), b = 0.1 * random.uniform(), t = random.uniform();
      const GroundBounds bounds = road->bounds({x, x + a, y, y + b}, t);
      const GroundPoint middle = road->at(x + 0.5 * a, y + 0.5 * b, t);
      const Eigen::Vector3d G(x + 0.5 * a, y + 0.5 * b, middle.height);
      planes += bounds.plane;
      for (int j = 0; j < 20; ++j) {
        const double px = x + a * random.uniform(), py = y + b * random.uniform();
        const GroundPoint point = road->at(px, py, t);
        EXPECT_LE(point.height, bounds.highest + 1e-12);
        if (bounds.cylinder) {
          const Cylinder& drum = *bounds.cylinder;
          const Eigen::Vector3d arm(px - drum.x, 0.0, point.height - drum.z);
          const Eigen::Vector3d rate(0.0, drum.rate, 0.0);
          EXPECT_NEAR(arm.norm(), drum.radius, 1e-12);
          EXPECT_LT((point.normal + drum.up * arm / drum.radius).norm(), 1e-12);
          EXPECT_LT((point.velocity - rate.cross(arm)).norm(), 1e-12);
          EXPECT_EQ(point.friction, drum.friction);
          ++cylinders;
        }
        if (!bounds.plane) continue;
        EXPECT_NEAR(middle.normal.dot(Eigen::Vector3d(px, py, point.height) - G), 0.0, 1e-12);
        EXPECT_EQ(point.friction, middle.friction);
      }
    }
  EXPECT_GT(planes, 500);
  EXPECT_GT(cylinders, 5000);
}

// The reference is the mean of many heights. Because of vertical edges a few would not suffice.
TEST(Road, MeanHeightIsTheIntegralOverTheWay) {
  Kerb ramped{.pitch = 0.1, .width = 0.2, .height = 0.02, .count = 3, .ramp = 0.05, .angle = 0.3};
  const ProfileRoad kerb = kerb_road(ramped);
  const ProfileRoad cleat = cleat_road(0.05, 0.02, 0.03, 0.005, 0.5);
  const ProfileRoad row({.along = cleat_profile(0.02, 0.03, 0.0), .pitch = 0.2, .belt = 2.0});
  const PlacedRoad placed(
      std::make_unique<ProfileRoad>(cleat_road(0.1, 0.02, 0.03, 0.005, 0.5)), 0.7, {0.1, 0.0, 0.3});
  RandomStream random(5, 1);
  for (const Road* road : std::initializer_list<const Road*>{&kerb, &cleat, &row, &placed}) {
    int uneven = 0;
    for (int i = 0; i < 60; ++i) {
      const Eigen::Vector2d from(0.4 * random.uniform() - 0.1, 0.3 * random.uniform() - 0.1);
      const Eigen::Vector2d to = from + 0.1 * Eigen::Vector2d(random.uniform(), random.uniform());
      const double time = random.uniform();
      constexpr int kParts = 20000;
      double sum = 0.0, low = 1e9, high = -1e9;
      for (int k = 0; k < kParts; ++k) {
        const Eigen::Vector2d at = from + (k + 0.5) / kParts * (to - from);
        const double z = road->height(at.x(), at.y(), time);
        sum += z / kParts;
        low = std::min(low, z);
        high = std::max(high, z);
      }
      // The reference locates a vertical flank only to half of a piece.
      EXPECT_NEAR(road->mean_height(from, to, time), sum, 1e-9 + 2.0 * 0.02 / kParts);
      uneven += high > low;
    }
    EXPECT_GT(uneven, 5);
  }
}

CrgGrid bumpy_grid(RandomStream& random, double du) {
  CrgGrid grid;
  grid.u_increment = du;
  for (int i = 0; i < 60; ++i) {
    grid.line.emplace_back(-0.3 + du * i, 0.01 * i * du);
    grid.line_height.push_back(0.001 * i * i * du);
  }
  for (double v = -0.5; v <= 0.51; v += 0.07) grid.v.push_back(v);
  for (std::size_t i = 0; i < grid.line.size() * grid.v.size(); ++i)
    grid.z.push_back(0.02 * random.uniform());
  return grid;
}

// The roads of this test are continuous. Lines are short relative to a wave length, as the
// quadrature rule for waves requires.
TEST(Road, MeanHeightOfTrianglesGridsAndWavesIsTheIntegral) {
  RandomStream random(5, 2);
  const TriangleRoad kerb(kerb_triangles({.shape = Kerb::Shape::sine,
                                          .pitch = 0.1,
                                          .width = 1.0,
                                          .height = 0.02,
                                          .count = 4,
                                          .ramp = 0.48,
                                          .start = {0.0, -0.5},
                                          .angle = 0.1},
                                         0.5));
  const CrgRoad grid(bumpy_grid(random, 0.02));
  const WaveRoad waves(
      {.start = -0.05, .amplitude_begin = 0.02, .amplitude_end = 0.02, .wave_length_begin = 1.3});
  for (const Road* road : std::initializer_list<const Road*>{&kerb, &grid, &waves})
    for (int i = 0; i < 100; ++i) {
      const Eigen::Vector2d from(0.3 * random.uniform() - 0.05, 0.1 * random.uniform() - 0.05);
      const double reach = road == &waves ? 0.04 : 0.1;
      const Eigen::Vector2d to =
          from + reach * Eigen::Vector2d(random.uniform() - 0.3, random.uniform() - 0.5);
      if (road == &waves && std::min(from.x(), to.x()) < -0.05) continue;
      constexpr int kParts = 4000;
      double sum = 0.0;
      for (int k = 0; k < kParts; ++k) {
        const Eigen::Vector2d at = from + (k + 0.5) / kParts * (to - from);
        sum += road->height(at.x(), at.y(), 0.0) / kParts;
      }
      // The error by a corner inside a piece is quadratic in the piece's length; kerbs have a few
      // hundred corners.
      EXPECT_NEAR(road->mean_height(from, to, 0.0), sum, 2e-8) << from << " " << to;
    }
}

// Evaluation of a row must equal evaluation at its single points up to rounding. The rows are
// oblique, cross repetitions and edges, and lie on sections, on triangles or beside all obstacles.
TEST(Road, BelowARowIsWhatIsBelowEachOfItsPlaces) {
  RandomStream random(5, 3);
  Kerb ramped{.pitch = 0.1, .width = 0.2, .height = 0.02, .count = 3, .ramp = 0.05, .angle = 0.3};
  const Kerb sine{.shape = Kerb::Shape::sine,
                  .pitch = 0.3,
                  .width = 0.4,
                  .height = -0.03,
                  .count = 2,
                  .friction = 0.7};
  const ProfileRoad kerb = kerb_road(ramped), fine = kerb_road(sine);
  const ProfileRoad belt({.along = cleat_profile(0.02, 0.03, 0.0), .pitch = 0.2, .belt = 2.0});
  const PlacedRoad placed(std::make_unique<ProfileRoad>(fine), 0.7, {0.1, 0.0, 0.3});
  const TriangleRoad triangles(kerb_triangles(sine, 0.2));
  constexpr int kCount = 7;
  for (const Road* road :
       std::initializer_list<const Road*>{&kerb, &fine, &belt, &placed, &triangles})
    for (int row = 0; row < 200; ++row) {
      const Eigen::Vector2d start(0.9 * random.uniform() - 0.2, 0.5 * random.uniform() - 0.1);
      const Eigen::Vector2d step(0.01 * random.uniform(), 0.002 * (random.uniform() - 0.5));
      const double time = random.uniform();
      double x[kCount], y[kCount], border_x[kCount + 1], border_y[kCount + 1];
      for (int j = 0; j <= kCount; ++j) {
        border_x[j] = start.x() + j * step.x();
        border_y[j] = start.y() + j * step.y();
        if (j == kCount) continue;
        x[j] = border_x[j] + 0.5 * step.x();
        y[j] = border_y[j] + 0.5 * step.y();
      }
      double at[9][kCount + 1];
      road->below({kCount, x, y, border_x, border_y},
                  time,
                  {.border_height = at[0],
                   .height = at[1],
                   .mean = at[2],
                   .slope = {at[3], at[4]},
                   .friction = at[5],
                   .velocity = {at[6], at[7], at[8]}});
      for (int j = 0; j <= kCount; ++j)
        EXPECT_NEAR(at[0][j], road->height(border_x[j], border_y[j], time), 1e-13);
      for (int j = 0; j < kCount; ++j) {
        const GroundPoint there = road->at(x[j], y[j], time);
        EXPECT_NEAR(at[1][j], there.height, 1e-13);
        EXPECT_NEAR(
            at[2][j],
            road->mean_height({border_x[j], border_y[j]}, {border_x[j + 1], border_y[j + 1]}, time),
            1e-6);
        for (int i = 0; i < 2; ++i)
          EXPECT_NEAR(at[3 + i][j], -there.normal[i] / there.normal.z(), 1e-12);
        EXPECT_EQ(at[5][j], there.friction);
        for (int i = 0; i < 3; ++i) EXPECT_NEAR(at[6 + i][j], there.velocity[i], 1e-13);
      }
    }
}

// If coordinates are so large that adding 1 to the index of a repetition does not change it, the
// loop over repetitions must still end.
TEST(Road, MeanHeightFarOutComesToAnEnd) {
  const ProfileRoad row({.along = cleat_profile(0.02, 0.03, 0.005), .pitch = 0.2});
  const double mean = row.mean_height({4e15, 0.0}, {4e15 + 1.0, 0.0}, 0.0);
  EXPECT_GE(mean, 0.0);
  EXPECT_LE(mean, 0.02);
}

// Bounds of a box converge to the height at a point if the box shrinks to this point. A search for
// the highest point by bisection therefore ends.
TEST(Road, BoundsCloseInOnAPoint) {
  const DrumRoad drum(
      {.diameter = 2.0,
       .cleats = {{.profile = cleat_profile(0.02, 0.03, 0.005)},
                  {.profile = cleat_profile(0.02, 0.03, 0.005), .starting_angle = 0.2}}});
  const DrumRoad inner(
      {.diameter = 3.0, .inner = true, .cleats = {{.profile = cleat_profile(0.02, 0.03, 0.005)}}});
  const ProfileRoad cleat = cleat_road(0.3, 0.02, 0.03, 0.005, 0.5);
  const ProfileRoad row({.along = cleat_profile(0.02, 0.03, 0.005), .pitch = 0.2});
  const ProfileRoad kerb =
      kerb_road({.pitch = 0.1, .width = 0.2, .height = 0.02, .count = 3, .ramp = 0.05});
  RandomStream random(4, 1);
  for (const Road* road : std::initializer_list<const Road*>{&drum, &inner, &cleat, &row, &kerb})
    for (int i = 0; i < 400; ++i) {
      const double x = 0.8 * (random.uniform() - 0.5), y = 0.4 * (random.uniform() - 0.5);
      constexpr double kSmall = 1e-6;
      const double highest = road->bounds({x, x + kSmall, y, y}, 0.0).highest;
      const double there = std::max(road->height(x, y, 0.0), road->height(x + kSmall, y, 0.0));
      EXPECT_NEAR(highest, there, 2.0 * kSmall) << x << " " << y;
    }
}

}  // namespace
}  // namespace latsch::road
