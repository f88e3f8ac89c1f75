// SPDX-License-Identifier: Apache-2.0
#include "models/suspension/linkage.h"

#include <gtest/gtest.h>

#include "models/suspension/geometry_testing.h"

namespace latsch::suspension {
namespace {

using Eigen::Vector3d;

TEST(MovingLinkage, KeepsItsLengthsAndReachesTheTravel) {
  const Linkage linkage = race_geometry().linkage;
  ASSERT_EQ(linkage.fault(), "");
  for (const TravelOf of : {TravelOf::contact, TravelOf::wheel_center}) {
    MovingLinkage moving(linkage, of);
    for (const auto& [travel, rack] :
         {std::pair{0.03, 0.0}, {-0.04, 0.01}, {0.05, -0.025}, {0.0, 0.03}}) {
      const auto pose = moving.move_to(travel, rack);
      ASSERT_TRUE(pose) << pose.failure().reason;
      for (int i = 0; i < Linkage::kLinks; ++i) {
        const Link& link = linkage.links[static_cast<std::size_t>(i)];
        Vector3d inner = link.inner;
        if (i == 4) inner.y() += rack;
        const Vector3d outer = pose->at(link.outer - linkage.wheel.center);
        EXPECT_NEAR((outer - inner).norm(), (link.outer - link.inner).norm(), 1e-13) << link.name;
      }
      const double z = pose->place.z() + (of == TravelOf::contact ? moving.to_contact().z() : 0.0);
      EXPECT_NEAR(z, (of == TravelOf::contact ? 0.0 : 0.235) + travel, 1e-13);
      EXPECT_LT((pose->turn.transpose() * pose->turn - Eigen::Matrix3d::Identity()).norm(), 1e-14);
    }
  }
}

// The position at a given travel must not depend on the path on which it was reached.
TEST(MovingLinkage, ComesBack) {
  const Linkage linkage = race_geometry().linkage;
  MovingLinkage moving(linkage, TravelOf::contact);
  for (const auto& [travel, rack] :
       {std::pair{0.05, 0.03}, {-0.05, 0.02}, {-0.03, -0.03}, {0.0, 0.0}})
    ASSERT_TRUE(moving.move_to(travel, rack));
  EXPECT_LT((moving.upright().place - linkage.wheel.center).norm(), 1e-12);
  EXPECT_LT((moving.upright().turn - Eigen::Matrix3d::Identity()).norm(), 1e-12);
}

/// Returns the difference between the twist of the upright and a central difference over 2 h.
double twist_error(double h, bool by_rack) {
  const Linkage linkage = race_geometry().linkage;
  MovingLinkage at(linkage, TravelOf::contact);
  EXPECT_TRUE(at.move_to(0.02, 0.01));
  MovingLinkage up = at, down = at;
  EXPECT_TRUE(up.move_to(by_rack ? 0.02 : 0.02 + h, by_rack ? 0.01 + h : 0.01));
  EXPECT_TRUE(down.move_to(by_rack ? 0.02 : 0.02 - h, by_rack ? 0.01 - h : 0.01));
  const Vector6d& twist = by_rack ? at.twists().by_rack : at.twists().by_travel;
  const Eigen::AngleAxisd turned(
      Eigen::Matrix3d(up.upright().turn * down.upright().turn.transpose()));
  Vector6d difference;
  difference << up.upright().place - down.upright().place, turned.angle() * turned.axis();
  return (difference / (2.0 * h) - twist).norm() / twist.norm();
}

TEST(MovingLinkage, TwistsAreTheLimitOfDifferencesWithOrderTwo) {
  for (const bool by_rack : {false, true}) {
    const double coarse = twist_error(8e-3, by_rack), fine = twist_error(4e-3, by_rack);
    EXPECT_NEAR(std::log2(coarse / fine), 2.0, 0.05) << by_rack;
    EXPECT_LT(twist_error(1e-4, by_rack), 1e-5) << by_rack;
  }
}

// If the arms are parallel and of equal length, a point of the upright travels on a circle with
// this radius. The path must end where the arms are vertical.
TEST(MovingLinkage, OfAParallelogramTravelsOnACircle) {
  const Linkage linkage = parallelogram().linkage;
  ASSERT_EQ(linkage.fault(), "");
  MovingLinkage moving(linkage, TravelOf::contact);
  for (const double travel : {0.1, -0.2, 0.29}) {
    ASSERT_TRUE(moving.move_to(travel, 0.0));
    EXPECT_LT((moving.upright().turn - Eigen::Matrix3d::Identity()).norm(), 1e-11);
    EXPECT_NEAR(
        moving.upright().place.y(), 0.7 - kArm + std::sqrt(kArm * kArm - travel * travel), 1e-12);
  }
  const auto beyond = moving.move_to(0.35, 0.0);
  ASSERT_FALSE(beyond);
  EXPECT_NEAR(moving.travel(), kArm, 1e-6);
  EXPECT_NE(beyond.failure().reason.find("travel 350 mm"), std::string::npos)
      << beyond.failure().reason;
  EXPECT_NE(beyond.failure().reason.find("ends the path at 300 mm"), std::string::npos)
      << beyond.failure().reason;
}

// The kingpin is vertical, the steering arm reaches 100 mm ahead of it, and the track-rod of 300 mm
// lies across. The rack can move until rod and arm are in line.
TEST(MovingLinkage, TheTrackRodIsNamedWhereTheRackGoesTooFar) {
  const Linkage linkage = parallelogram().linkage;
  MovingLinkage moving(linkage, TravelOf::contact);
  const auto found = moving.move_to(0.0, -0.25);
  ASSERT_FALSE(found);
  EXPECT_NE(found.failure().reason.find("trackrod ends the path"), std::string::npos)
      << found.failure().reason;
  // Rod and arm are then in line, and the inner end is 0.1 m ahead of the kingpin.
  EXPECT_NEAR(moving.rack(), 0.3 - std::sqrt(0.4 * 0.4 - 0.1 * 0.1), 1e-6);
}

TEST(Linkage, FaultsNameTheirPart) {
  const Linkage good = parallelogram().linkage;
  Linkage bad = good;
  bad.links[2].inner *= 1e3;
  EXPECT_NE(bad.fault().find("the inner end of lca_front"), std::string::npos) << bad.fault();
  EXPECT_NE(bad.fault().find("millimeters"), std::string::npos) << bad.fault();
  bad = good;
  bad.links[4].inner = bad.links[4].outer;
  EXPECT_EQ(bad.fault(), "both ends of trackrod coincide");
  bad = good;
  bad.links[4].outer = {0.0, 0.6, 0.3};  // the outer end of the track-rod lies on the kingpin
  EXPECT_NE(bad.fault().find("trackrod"), std::string::npos) << bad.fault();
  EXPECT_NE(bad.fault().find("singular"), std::string::npos) << bad.fault();
  bad = good;
  bad.links[1].inner = bad.links[0].inner - Vector3d(0.0, 0.1, 0.0) * 0.0;
  EXPECT_NE(bad.fault().find("uca_front, uca_rear"), std::string::npos) << bad.fault();
  bad = good;
  bad.wheel.radius = 0.0;
  EXPECT_NE(bad.fault().find("contact"), std::string::npos) << bad.fault();
}

}  // namespace
}  // namespace latsch::suspension
