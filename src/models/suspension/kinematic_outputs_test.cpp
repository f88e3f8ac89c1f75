// SPDX-License-Identifier: Apache-2.0
#include "models/suspension/kinematic_outputs.h"

#include <gtest/gtest.h>

#include <set>

#include "models/suspension/axle_kinematics.h"
#include "models/suspension/geometry_testing.h"

namespace latsch::suspension {
namespace {

WheelKinematics at(const CornerGeometry& corner,
                   double travel,
                   double rack = 0.0,
                   TravelOf of = TravelOf::contact) {
  EXPECT_EQ(corner.fault(), "");
  const auto found = KinematicCorner(corner, of).move_to(travel, rack);
  EXPECT_TRUE(found) << found.failure().reason;
  return *found;
}

TEST(KinematicOutputs, EqualParallelWishbonesNeitherLeanNorSteer) {
  const CornerGeometry corner = parallelogram();
  for (const double travel : {-0.1, 0.0, 0.12}) {
    const WheelKinematics w = at(corner, travel);
    EXPECT_NEAR(w.camber, 0.0, 1e-12);
    EXPECT_NEAR(w.toe, 0.0, 1e-12);
    EXPECT_NEAR(w.bump_camber, 0.0, 1e-11);
    EXPECT_NEAR(w.bump_steer, 0.0, 1e-11);
  }
}

// The normal to the path of the contact point is parallel to the arms and passes through the
// contact point at y = 0.7 m.
TEST(KinematicOutputs, RollCenterOfAParallelogramIsInLineWithItsArms) {
  EXPECT_NEAR(at(parallelogram(), 0.0).roll_center_height, 0.0, 1e-14);
  for (const double angle : {-0.1, 0.05, 0.2}) {
    const WheelKinematics w = at(parallelogram(0.0, angle), 0.0);
    EXPECT_NEAR(w.roll_center_height, -std::tan(angle) * 0.7, 1e-13);
  }
  const double travel = 0.06, angle = std::asin(travel / kArm);
  const WheelKinematics w = at(parallelogram(), travel);
  EXPECT_NEAR(w.roll_center_height, -std::tan(angle) * w.contact_y, 1e-12);
  // The roll-center height is h(z) = -tan(asin(z / l)) (y_0 + l cos(asin(z / l))). Its derivative
  // at z = 0 is -y / l.
  EXPECT_NEAR(at(parallelogram(), 0.0).roll_center_by_travel, -0.7 / kArm, 1e-5);
}

TEST(KinematicOutputs, SlopesAreThoseOfDifferences) {
  const CornerGeometry corner = race_geometry();
  for (const TravelOf of : {TravelOf::contact, TravelOf::wheel_center}) {
    const double h = 1e-5, travel = 0.02, rack = 0.012;
    const WheelKinematics w = at(corner, travel, rack, of);
    const WheelKinematics up = at(corner, travel + h, rack, of),
                          down = at(corner, travel - h, rack, of);
    const WheelKinematics left = at(corner, travel, rack + h, of),
                          right = at(corner, travel, rack - h, of);
    const auto by_travel = [&](double WheelKinematics::*y) { return (up.*y - down.*y) / (2 * h); };
    const auto by_rack = [&](double WheelKinematics::*y) { return (left.*y - right.*y) / (2 * h); };
    using W = WheelKinematics;
    // Error bound of a difference: truncation of order h² plus rounding of 1e-13 divided by 2 h.
    const double e = 1e-7;
    EXPECT_NEAR(by_travel(&W::toe), w.bump_steer, e);
    EXPECT_NEAR(by_travel(&W::camber), w.bump_camber, e);
    EXPECT_NEAR(by_travel(&W::center_x), w.center_x_by_travel, e);
    EXPECT_NEAR(by_travel(&W::center_y), w.center_y_by_travel, e);
    EXPECT_NEAR(by_travel(&W::center_z), w.center_z_by_travel, e);
    EXPECT_NEAR(by_travel(&W::contact_z), w.contact_z_by_travel, e);
    EXPECT_NEAR(by_travel(&W::spring_length), -w.motion_ratio * w.contact_z_by_travel, e);
    EXPECT_NEAR(by_travel(&W::arb_angle), w.arb_ratio, 1e-5);
    EXPECT_NEAR(by_rack(&W::steer), w.steer_by_rack, e * 10);
    EXPECT_NEAR(by_rack(&W::camber), w.camber_by_rack, e);
  }
}

// The vertical force at the contact point that balances the spring force F is i F. Its derivative
// by travel is the wheel rate.
TEST(KinematicOutputs, WheelRateIsTheSlopeOfTheForceThatHoldsTheSpring) {
  const CornerGeometry corner = race_geometry();
  const auto rest = at(corner, 0.0);
  const auto force = [&](double travel) {
    const auto w = at(corner, travel);
    const double spring =
        65.0 * 9.80665 / rest.motion_ratio + 52538.0 * (rest.spring_length - w.spring_length);
    return w.motion_ratio * spring;
  };
  for (const double travel : {-0.02, 0.0, 0.025}) {
    const double h = 1e-4, slope = (force(travel + h) - force(travel - h)) / (2 * h);
    const auto w = at(corner, travel);
    EXPECT_NEAR(w.wheel_rate / slope, 1.0, 1e-5);
    EXPECT_NEAR(1.0 / w.ride_rate, 1.0 / w.wheel_rate + 1.0 / 117000.0, 1e-15);
    EXPECT_NEAR(w.ride_frequency, std::sqrt(w.ride_rate / 65.0) / (2.0 * M_PI), 1e-12);
  }
}

TEST(KinematicOutputs, ARightCornerIsTheMirrorImageOfTheLeft) {
  CornerGeometry left = race_geometry();
  left.linkage.wheel.spin_axis = Eigen::Vector3d(0.01, 1.0, 0.03).normalized();
  left.linkage.wheel.offset = 0.01;
  const CornerGeometry right = right_of(left);
  for (const auto& [travel, rack] : {std::pair{0.0, 0.0}, {0.03, 0.02}, {-0.025, -0.01}}) {
    const WheelKinematics a = mirrored(at(left, travel, rack)), b = at(right, travel, -rack);
    for (const KinematicOutput& output : kinematic_outputs()) {
      // Second derivatives are differences over 0.1 mm, which enlarges rounding errors.
      const double value = b.*output.value, size = std::max(1.0, std::abs(value));
      const bool is_second = std::string(output.name).ends_with("_by_travel") &&
                             (output.value == &WheelKinematics::roll_center_by_travel ||
                              output.value == &WheelKinematics::motion_ratio_by_travel);
      const bool of_second = output.group == KinematicOutput::Group::rates;
      EXPECT_NEAR(a.*output.value, value, (is_second || of_second ? 1e-7 : 1e-12) * size)
          << output.name;
    }
  }
}

TEST(KinematicOutputs, HaveNamesOfTheirOwn) {
  std::set<std::string> names;
  for (const KinematicOutput& output : kinematic_outputs()) names.insert(output.name);
  EXPECT_EQ(names.size(), kinematic_outputs().size());
}

// At rest the wheel has the toe and camber that the geometry states.
TEST(KinematicOutputs, AWheelStandsAsItIsSet) {
  CornerGeometry corner = parallelogram();
  const double toe = 0.004, camber = -0.03;
  corner.linkage.wheel.spin_axis = {
      std::sin(toe) * std::cos(camber), std::cos(toe) * std::cos(camber), -std::sin(camber)};
  const WheelKinematics w = at(corner, 0.05);
  EXPECT_NEAR(w.toe, toe, 1e-12);
  EXPECT_NEAR(w.camber, camber, 1e-12);
  // The top of the wheel leans inboard, so its lowest point is outboard of the center.
  EXPECT_NEAR(w.contact_y - w.center_y, 0.3 * std::sin(-camber), 2e-6);
}

TEST(SignViews, TurnAxesAround) {
  using enum Sense;
  for (const Sense sense : {same, along_x, along_y, along_z, about_x, about_y, about_z})
    EXPECT_EQ(sign(SignView::iso, sense), 1.0);
  // A positive steer angle means steering to the left in ISO 8855 and Adams, to the right in SAE
  // J670.
  EXPECT_EQ(sign(SignView::sae, about_z), -1.0);
  EXPECT_EQ(sign(SignView::adams, about_z), 1.0);
  EXPECT_EQ(sign(SignView::sae, along_z), -1.0);
  EXPECT_EQ(sign(SignView::adams, along_x), -1.0);
  // In SAE, steering to the right per rack travel to the right is positive.
  EXPECT_EQ(sign(SignView::sae, about_z, along_y), 1.0);
  for (const SignView view : {SignView::iso, SignView::sae, SignView::adams})
    // The axes of the view form a right-handed system, so it is a proper rotation.
    EXPECT_EQ(sign(view, about_x), sign(view, along_x));
}

}  // namespace
}  // namespace latsch::suspension
