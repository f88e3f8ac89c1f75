// SPDX-License-Identifier: Apache-2.0
// Tests the static equilibrium of a corner against numbers on which two independent programs agree
// to every digit printed.
#include <gtest/gtest.h>

#include <numbers>

#include "models/multibody/equilibrium.h"
#include "models/suspension/corner_testing.h"

namespace latsch::suspension {
namespace {

using Eigen::Vector3d;
using namespace multibody;

constexpr double kDegree = std::numbers::pi / 180.0;

struct Case {
  const char* name;
  Vector3d force, moment;
  std::array<double, 6> moved;  // dx, dy, dz in mm; camber, toe-in, caster in deg
};

const std::array<Case, 4> kCases = {
    {{"Fz", {0, 0, 5e3}, {0, 0, 0}, {0.50025, 0.19826, 1.28328, -0.05050, -0.05471, 0.09804}},
     {"Fy", {0, -4e3, 0}, {0, 0, 0}, {0.02265, -0.56246, -0.16064, 0.07710, 0.33106, -0.02222}},
     {"Fx", {-4e3, 0, 0}, {0, 0, 0}, {-2.09541, 0.02029, -0.38792, 0.01553, -0.16255, -0.39332}},
     {"Mz", {0, 0, 0}, {0, 0, 200}, {-0.14040, 0.28764, 0.03827, 0.00779, -0.52194, 0.01273}}}};

std::array<double, 6> moved(const WheelPosition& at, const WheelPosition& rest) {
  const Vector3d d = 1e3 * (at.contact - rest.contact);
  return {d.x(),
          d.y(),
          d.z(),
          (at.camber - rest.camber) / kDegree,
          (at.toe - rest.toe) / kDegree,
          (at.caster - rest.caster) / kDegree};
}

class SuspensionCorner : public testing::Test {
 protected:
  DoubleWishbone corner_ = race_corner();
  Mechanism mechanism_{corner_.bodies(), corner_.joints()};
  WheelPoints wheel_ = corner_.wheel();

  Load load(const Vector3d& force, const Vector3d& moment) const {
    return {DoubleWishbone::kUpright, corner_.contact, force, moment};
  }
  WheelPosition wheel(const Poses& poses) const {
    return wheel_position(wheel_, poses[DoubleWishbone::kUpright]);
  }
};

TEST_F(SuspensionCorner, MovesAsTwoIndependentProgramsSay) {
  ASSERT_EQ(corner_.fault(), "");
  ASSERT_EQ(Mechanism::fault(corner_.bodies(), corner_.joints()), "");
  Equilibrium statics(mechanism_);
  const WheelPosition rest = wheel(mechanism_.at_rest());
  for (const Case& one : kCases) {
    const Load on = load(one.force, one.moment);
    const auto poses = statics.solve({&on, 1});
    ASSERT_TRUE(poses) << poses.failure().reason;
    EXPECT_LE(statics.left(), 1e-6);
    EXPECT_LE(statics.iterations(), 4);
    const std::array<double, 6> found = moved(wheel(*poses), rest);
    for (std::size_t i = 0; i < 6; ++i)
      EXPECT_NEAR(found[i], one.moved[i], 0.5e-5 + 1e-9) << one.name << " " << i;
  }
}

TEST_F(SuspensionCorner, ComplianceIsTheSlopeOfItsStatics) {
  Equilibrium statics(mechanism_);
  const Load on = load({-500.0, -2000.0, 3000.0}, {0.0, 0.0, 50.0});
  const Poses poses = *statics.solve({&on, 1});
  const Vector3d arm = poses[DoubleWishbone::kUpright].turn * wheel_.contact;
  ASSERT_TRUE(statics.linearize(poses, {&on, 1}).ok());
  const Matrix6d slopes =
      wheel_slopes(wheel_, poses[DoubleWishbone::kUpright]) *
      statics.compliance(DoubleWishbone::kUpright, DoubleWishbone::kUpright, arm);
  for (int i = 0; i < 6; ++i) {
    const double h = i < 3 ? 10.0 : 1.0;
    const auto at = [&](double by) {
      Load more = on;
      (i < 3 ? more.force : more.moment)[i % 3] += by;
      return wheel(*statics.solve({&more, 1}));
    };
    const WheelPosition up = at(h), down = at(-h);
    Vector6d differences;
    differences << (up.contact - down.contact), up.camber - down.camber, up.toe - down.toe,
        up.caster - down.caster;
    differences /= 2.0 * h;
    EXPECT_LT((slopes.col(i) - differences).norm(), 1e-6 * differences.norm()) << i;
  }
}

TEST_F(SuspensionCorner, SlopesInStiffnessesAreThoseOfDifferences) {
  Equilibrium statics(mechanism_);
  const Load on = load({-500.0, -2000.0, 3000.0}, {0.0, 0.0, 50.0});
  const Poses poses = *statics.solve({&on, 1});
  ASSERT_TRUE(statics.linearize(poses, {&on, 1}).ok());
  Eigen::MatrixXd by_pose = Eigen::MatrixXd::Zero(30, 6);
  by_pose.middleRows<6>(6 * DoubleWishbone::kUpright) =
      wheel_slopes(wheel_, poses[DoubleWishbone::kUpright]).transpose();
  const Eigen::MatrixXd slopes = statics.by_stiffness(poses, by_pose);
  for (int p = 0; p < 60; ++p) {
    const auto at = [&](double by) {
      DoubleWishbone changed = corner_;
      BushingParameters& one = changed.bushings[static_cast<std::size_t>(p / 6)];
      (p % 6 < 3 ? one.stiffness : one.rotational)[p % 3] *= 1.0 + by;
      const Mechanism mechanism(changed.bodies(), changed.joints());
      return wheel(*Equilibrium(mechanism, {.force = 1e-7}).solve({&on, 1}));
    };
    const double h = 1e-3;
    const WheelPosition up = at(h), down = at(-h);
    const double stiffness = p % 6 < 3 ? 3e7 : 200.0;
    Vector6d differences;
    differences << (up.contact - down.contact), up.camber - down.camber, up.toe - down.toe,
        up.caster - down.caster;
    differences /= 2.0 * h;
    // A residual force of 1e-7 N displaces the wheel by 1e-14 m or rad, an error which the central
    // difference divides by 2 h.
    EXPECT_LT((slopes.col(p) * stiffness - differences).norm(), 1e-5 * differences.norm() + 5e-12)
        << DoubleWishbone::kNames[static_cast<std::size_t>(p / 6)] << " " << p % 6;
  }
}

TEST_F(SuspensionCorner, OfTheRightSideIsItsMirrorImage) {
  DoubleWishbone right = corner_;
  for (Vector3d& point : right.points) point.y() = -point.y();
  right.wheel_center.y() = -right.wheel_center.y();
  right.contact.y() = -right.contact.y();
  right.side = Side::right;
  const Mechanism mirrored(right.bodies(), right.joints());
  Equilibrium statics(mechanism_), of_right(mirrored);
  const Load on = load({-4e3, -4e3, 5e3}, Vector3d::Zero());
  const Load on_right{DoubleWishbone::kUpright, right.contact, {-4e3, 4e3, 5e3}};
  const WheelPosition a = wheel(*statics.solve({&on, 1}));
  const WheelPosition b =
      wheel_position(right.wheel(), (*of_right.solve({&on_right, 1}))[DoubleWishbone::kUpright]);
  EXPECT_NEAR(a.contact.y(), -b.contact.y(), 1e-12);
  EXPECT_NEAR(a.camber, b.camber, 1e-12);
  EXPECT_NEAR(a.toe, b.toe, 1e-12);
  EXPECT_NEAR(a.caster, b.caster, 1e-12);
}

TEST_F(SuspensionCorner, LoadsBeyondWhatItHoldsFailInWords) {
  for (BushingParameters& bushing : corner_.bushings) bushing.stiffness.setConstant(1e3);
  const Mechanism soft(corner_.bodies(), corner_.joints());
  const Load on = load(Vector3d::Zero(), {0.0, 0.0, 1e6});
  const auto poses = Equilibrium(soft).solve({&on, 1});
  ASSERT_FALSE(poses);
  EXPECT_NE(poses.failure().reason.find("no equilibrium beyond"), std::string::npos)
      << poses.failure().reason;
}

TEST_F(SuspensionCorner, JointsThatHardlyGiveAreSolvedAsFarAsNumbersGo) {
  const Load on = load({0.0, 0.0, 5e3}, Vector3d::Zero());
  const WheelPosition rest = wheel(mechanism_.at_rest());
  const auto travel = [&](double stiffness) {
    for (BushingParameters& bushing : corner_.bushings) bushing.stiffness.setConstant(stiffness);
    const Mechanism stiff(corner_.bodies(), corner_.joints());
    const auto poses = Equilibrium(stiff).solve({&on, 1});
    EXPECT_TRUE(poses) << poses.failure().reason;
    return (wheel(*poses).contact - rest.contact).norm();
  };
  EXPECT_NEAR(travel(1e12) / travel(1e9), 1e-3, 1e-6);
}

TEST_F(SuspensionCorner, BushingsSoSoftThatItTurnsOverAreNamed) {
  for (BushingParameters& bushing : corner_.bushings) bushing.stiffness.setConstant(3e3);
  const Mechanism soft(corner_.bodies(), corner_.joints());
  const Load on = load({0.0, 0.0, 5e3}, Vector3d::Zero());
  const auto poses = Equilibrium(soft).solve({&on, 1});
  ASSERT_FALSE(poses);
  EXPECT_NE(poses.failure().reason.find("is turned most"), std::string::npos)
      << poses.failure().reason;
}

TEST_F(SuspensionCorner, ARodThatSpinsFreelyIsNamed) {
  for (BushingParameters& bushing : corner_.bushings) bushing.rotational.setZero();
  const std::string fault = Mechanism::fault(corner_.bodies(), corner_.joints());
  EXPECT_NE(fault.find("the push-rod spins freely from pushrod_inner to pushrod_outer"),
            std::string::npos)
      << fault;
  EXPECT_NE(fault.find("no rotational stiffness (about_x"), std::string::npos) << fault;
  // A body with mass is allowed to spin freely in motion. It then has no unique equilibrium.
  auto bodies = corner_.bodies();
  for (multibody::Body& body : bodies) body.mass = 1.0;
  ASSERT_EQ(Mechanism::fault(bodies, corner_.joints()), "");
  const Mechanism free(bodies, corner_.joints());
  const Load on = load({0.0, 0.0, 5e3}, Vector3d::Zero());
  const auto poses = Equilibrium(free).solve({&on, 1});
  ASSERT_FALSE(poses);
  EXPECT_NE(poses.failure().reason.find("rod"), std::string::npos) << poses.failure().reason;
}

TEST_F(SuspensionCorner, PartsThatMakeNoneAreNamed) {
  DoubleWishbone bad = corner_;
  bad.points[DoubleWishbone::kUbj] = bad.points[DoubleWishbone::kUcaFront];
  EXPECT_NE(bad.fault().find("uca_front, uca_rear and ubj"), std::string::npos) << bad.fault();
  bad = corner_;
  bad.points[DoubleWishbone::kLbj] *= 1e3;
  EXPECT_NE(bad.fault().find("millimeters"), std::string::npos) << bad.fault();
  bad = corner_;
  bad.bushings[DoubleWishbone::kTrackrodOuter].stiffness.setZero();
  const std::string fault = Mechanism::fault(bad.bodies(), bad.joints());
  EXPECT_NE(fault.find("trackrod_outer"), std::string::npos) << fault;
}

}  // namespace
}  // namespace latsch::suspension
