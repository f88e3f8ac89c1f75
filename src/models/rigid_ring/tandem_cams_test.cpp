// SPDX-License-Identifier: Apache-2.0
#include "models/rigid_ring/tandem_cams.h"

#include <gtest/gtest.h>

#include <cmath>
#include <memory>
#include <vector>

#include "models/rigid_ring/cam_contact.h"
#include "models/road/crg_road.h"
#include "models/road/drum_road.h"
#include "models/road/kerb.h"
#include "models/road/plane_road.h"
#include "models/road/profile_road.h"
#include "models/road/triangle_road.h"
#include "models/road/two_track_road.h"
#include "models/road/wave_road.h"

namespace latsch::rigid_ring {
namespace {

using Eigen::Vector2d;
using Eigen::Vector3d;
using road::Road;

magic_formula::Parameters cams_of(double tracks) {
  magic_formula::Parameters p;
  p.UNLOADED_RADIUS = 0.3;
  p.ELLIPS_NWIDTH = tracks;
  return p;
}

/// Returns the maximum of height and depth over 10,000 points a side.
double densely(const CamOutline& cam, const Vector2d& at, const Road& road) {
  constexpr int kParts = 10000;
  double highest = -1e9;
  for (int i = -kParts; i <= kParts; ++i) {
    const double x = cam.a * i / kParts;
    highest = std::max(highest, road.height(at.x() + x, at.y(), 0.0) + cam.depth(x));
  }
  return highest;
}

TEST(CamOutline, IsAnEllipseOfOrderTwoAndTouchesWhereItsSlopeSays) {
  const CamOutline ellipse{0.3, 0.2, 2.0};
  EXPECT_NEAR(ellipse.depth(0.18), 0.2 * 0.8, 1e-15);
  for (const double order : {1.4, 1.8, 2.5}) {
    const CamOutline cam{0.3, 0.2, order};
    for (const double x : {-0.2, -0.01, 0.004, 0.25}) {
      constexpr double h = 1e-6;
      const double difference = (cam.depth(x + h) - cam.depth(x - h)) / (2.0 * h);
      EXPECT_NEAR(cam.slope(x), difference, 1e-6) << x;
      EXPECT_NEAR(cam.touch(-cam.slope(x)), x, 1e-12) << x;
    }
  }
}

// On a slope of tan = s the definition gives max(s x + depth(x)). By the inequality dual to the
// outline's norm this is b (1 + (s a/b)^(c/(c-1)))^((c-1)/c), equal for both cams.
TEST(TandemCams, OnAPlainSlopeStandAsTheirOutlineSays) {
  const auto p = cams_of(3.0);
  const TandemCams cams(p);
  for (const double grade : {0.0, 0.08, -0.3}) {
    const road::PlaneRoad road({.grade = grade, .bank = 0.03});
    const auto plane = cams.plane({2.0, 1.0, 0.6}, Vector3d::UnitX(), 0.06, 0.08, road, 0.0);
    const double dual = p.ELLIPS_ORDER / (p.ELLIPS_ORDER - 1.0);
    const double above = 0.3 * (std::pow(1.0 + std::pow(std::abs(grade), dual), 1.0 / dual) - 1.0);
    const road::GroundPoint ground = road.at(2.0, 1.0, 0.0);
    EXPECT_NEAR(plane.point.z() - ground.height, above, 1e-12);
    EXPECT_LT((plane.normal - ground.normal).norm(), 1e-12);
  }
}

// Before a vertical flank of height h a cam with its middle at the distance d stands on the edge,
// at height h + depth(d), or on the level road if that is less than b.
TEST(TandemCams, BeforeAStepStandOnItsEdge) {
  const auto p = cams_of(1.0);
  constexpr double h = 0.02, a = 0.05;
  const double l_s = p.ELLIPS_SHIFT * 2.0 * a;
  const road::ProfileRoad road({.along = road::Profile({{0.0, 0.0}, {0.0, h}})});
  const CamOutline cam{0.3, 0.3, p.ELLIPS_ORDER};
  const TandemCams cams(p);
  for (double x = -0.35; x < 0.35; x += 0.0031) {
    const auto Z = [&](double middle) {
      return middle >= 0.0 ? cam.b + h : std::max(cam.b, h + cam.depth(middle));
    };
    const double Z_f = Z(x + 0.5 * l_s), Z_r = Z(x - 0.5 * l_s);
    const auto plane = cams.plane({x, 0.0, 0.3}, Vector3d::UnitX(), a, 0.08, road, 0.0);
    EXPECT_NEAR(plane.point.z(), 0.5 * (Z_f + Z_r) - cam.b, 1e-6) << x;
    EXPECT_NEAR(-plane.normal.x() / plane.normal.z(), (Z_f - Z_r) / l_s, 2e-5) << x;
  }
}

/// A road with the heights of another one and without bounds.
class SilentRoad final : public Road {
 public:
  explicit SilentRoad(const Road& road) : road_(road) {}
  road::GroundPoint at(double x, double y, double time) const override {
    return road_.at(x, y, time);
  }

 private:
  const Road& road_;
};

road::CrgRoad rough_grid() {
  road::CrgGrid grid;
  grid.u_increment = 0.01;
  grid.v = {-0.2, 0.0, 0.2};
  for (int row = 0; row < 120; ++row) {
    grid.line.emplace_back(-0.6 + 0.01 * row, 1e-3 * std::sin(0.05 * row));
    grid.line_height.push_back(0.0);
    for (int c = 0; c < 3; ++c) grid.z.push_back(0.006 * std::sin(1.7 * row * row + c));
  }
  return road::CrgRoad(grid);
}

// Every kind of road is compared with the maximum over 20,000 points, with the road's bounds and
// without. Beside a flank the points miss the edge by their distance, 0.03 mm, times the outline's
// slope.
TEST(CamContact, FindsTheHighestOfManyPointsOnEveryRoad) {
  const road::Kerb saw{.height = 0.025, .count = 2, .start = {-0.8, -0.4}};
  const road::ProfileRoad cleat = road::cleat_road(0.05, 0.01, 0.02, 0.003, 0.3),
                          kerb = road::kerb_road(saw);
  const road::TriangleRoad triangles(road::kerb_triangles(saw, 0.5));
  const road::DrumRoad drum({.diameter = 2.0,
                             .cleats = {{.profile = road::cleat_profile(0.02, 0.03, 0.005),
                                         .starting_angle = 0.1,
                                         .angle = 0.6}}});
  const road::DrumRoad inner({.diameter = 3.0, .inner = true});
  const road::WaveRoad wave({.start = -0.4,
                             .end = 0.4,
                             .amplitude_begin = 0.02,
                             .amplitude_end = 0.005,
                             .wave_length_begin = 0.3,
                             .wave_length_end = 0.05});
  const road::TwoTrackRoad tracks(
      road::cleat_profile(0.01, 0.02, 0.003), road::cleat_profile(-0.01, 0.05, 0.003), 1.0);
  const road::CrgRoad grid = rough_grid();
  const CamOutline cam{0.32, 0.3, 1.8};
  int number = 0;
  for (const Road* road : std::initializer_list<const Road*>{
           &cleat, &kerb, &triangles, &drum, &inner, &wave, &tracks, &grid}) {
    const SilentRoad silent(*road);
    for (const double x : {-0.1, -0.013, 0.0, 0.071}) {
      const Vector2d at(x, 0.01);
      const double dense = densely(cam, at, *road);
      const double told = CamContact(cam, at, Vector2d::UnitX(), *road, 0.0).height();
      const double silently = CamContact(cam, at, Vector2d::UnitX(), silent, 0.0).height();
      EXPECT_GT(told, dense - 1e-7) << number << " at " << x;
      EXPECT_LT(told, dense + 2e-5) << number << " at " << x;
      EXPECT_NEAR(silently, told, 1e-7) << number << " at " << x;
    }
    ++number;
  }
}

// A plate of 0.3 mm is thinner than the first spacing of samples; bounds of the road must reveal
// it.
TEST(CamContact, SeesAThinPlate) {
  const road::ProfileRoad road = road::cleat_road(0.0337, 0.02, 3e-4, 0.0);
  const CamOutline cam{0.3, 0.3, 1.8};
  for (double x = -0.05; x < 0.1; x += 0.0077) {
    const double beside = std::max(std::abs(0.0337 - x) - 1.5e-4, 0.0);
    EXPECT_NEAR(CamContact(cam, {x, 0.0}, Vector2d::UnitX(), road, 0.0).height(),
                std::max(cam.b, 0.02 + cam.depth(beside)),
                1e-7)
        << x;
  }
}

}  // namespace
}  // namespace latsch::rigid_ring
