// SPDX-License-Identifier: Apache-2.0
#include "models/magic_formula/magic_formula_tire.h"

#include <gtest/gtest.h>

#include <Eigen/Geometry>
#include <cmath>

#include "models/magic_formula/round_tire_testing.h"
#include "models/road/plane_road.h"

namespace latsch::magic_formula {
namespace {

using Eigen::AngleAxisd;
using Eigen::Vector3d;

constexpr double kSpeed = 20.0;

/// A wheel at its loaded radius for `load`, rolling freely ahead but for the slips.
WheelMotion rolling(const MagicFormula& formula, double load, double alpha, double kappa) {
  const SteadyState s = formula.evaluate({load, kappa, alpha, 0.0, 0.0, kSpeed, 2.2e5});
  WheelMotion motion;
  motion.center = {0.0, 0.0, s.R_l};
  motion.velocity = {kSpeed, kSpeed * std::tan(alpha), 0.0};
  motion.spin_rate = (1.0 + kappa) * kSpeed / s.R_e;
  return motion;
}

TEST(MagicFormulaTire, AfterALongWayTheForcesAreTheSteadyState) {
  const Parameters p = round_tire();
  const MagicFormula formula(p);
  const road::PlaneRoad road;
  for (const int mode : {4, 14, 24}) {
    MagicFormulaTireSettings settings;
    settings.use_mode = mode;
    MagicFormulaTire tire(p, settings);
    const WheelMotion motion = rolling(formula, 4000.0, 0.05, 0.03);
    for (int i = 0; i < 2000; ++i) ASSERT_TRUE(tire.advance(motion, road, 0.0, 1e-3).ok());
    const SteadyState s = formula.evaluate({4000.0, 0.03, 0.05, 0.0, 0.0, kSpeed, 2.2e5});
    EXPECT_NEAR(tire.contact_forces().Fz, 4000.0, 1e-6);
    EXPECT_NEAR(tire.contact_forces().Fx, s.Fx, 1e-5);
    EXPECT_NEAR(tire.contact_forces().Fy, s.Fy, 1e-5);
    EXPECT_NEAR(tire.contact_forces().Mz, s.Mz, 1e-6);
  }
}

TEST(MagicFormulaTire, ASmallStepInSlipAngleRelaxesOverItsLength) {
  const Parameters p = round_tire();
  const MagicFormula formula(p);
  const road::PlaneRoad road;
  MagicFormulaTire tire(p);
  const double alpha = 1e-4;
  const WheelMotion motion = rolling(formula, 4000.0, alpha, 0.0);
  const SteadyState s = formula.evaluate({4000.0, 0.0, alpha, 0.0, 0.0, kSpeed, 2.2e5});
  const double time = s.sigma_y / kSpeed;  // one relaxation length
  for (int i = 0; i < 1000; ++i) ASSERT_TRUE(tire.advance(motion, road, 0.0, time / 1000).ok());
  EXPECT_NEAR(tire.lagged_alpha() / alpha, 1.0 - std::exp(-1.0), 1e-8);  // exact for any step
  MagicFormulaTire coarse(p);
  ASSERT_TRUE(coarse.advance(motion, road, 0.0, time).ok());
  EXPECT_NEAR(coarse.lagged_alpha(), tire.lagged_alpha(), 1e-12);
}

TEST(MagicFormulaTire, HubForcesBalanceTheContactOnACamberedWheelAndASlope) {
  road::PlaneRoad::Settings slope;
  slope.grade = 0.05;
  slope.bank = 0.03;
  const road::PlaneRoad road(slope);
  MagicFormulaTire tire(round_tire());
  WheelMotion motion;
  motion.center = {1.0, 0.5, 0.37};
  motion.carrier = AngleAxisd(0.05, Vector3d::UnitX()).toRotationMatrix();
  motion.velocity = {15.0, 0.3, 0.0};
  motion.spin_rate = 51.0;
  for (int i = 0; i < 200; ++i) ASSERT_TRUE(tire.advance(motion, road, 0.0, 1e-3).ok());
  const auto hub = tire.advance(motion, road, 0.0, 1e-3);
  ASSERT_TRUE(hub.ok());
  const WheelContact contact = *touch(motion, tangent_plane(motion, road, 0.0));
  const SteadyState& w = tire.contact_forces();
  const Vector3d force = contact.axes * Vector3d(w.Fx, w.Fy, w.Fz);
  EXPECT_LT((motion.carrier * hub->force - force).norm(), 1e-9);
  const Vector3d moment =
      contact.axes * Vector3d(w.Mx, w.My, w.Mz) + (contact.point - motion.center).cross(force);
  EXPECT_LT((motion.carrier * hub->moment - moment).norm(), 1e-9);
  const road::GroundPoint ground = road.at(contact.point.x(), contact.point.y(), 0.0);
  EXPECT_NEAR(ground.height, contact.point.z(), 1e-12);  // the contact lies on the road
}

TEST(MagicFormulaTire, AWheelThatLeansRightIsPushedRight) {
  const MagicFormula formula(round_tire());
  MagicFormulaTire tire(round_tire());
  WheelMotion motion = rolling(formula, 4000.0, 0.0, 0.0);
  motion.carrier = AngleAxisd(0.05, Vector3d::UnitX()).toRotationMatrix();  // top toward -y
  for (int i = 0; i < 100; ++i) (void)tire.advance(motion, road::PlaneRoad(), 0.0, 1e-3);
  EXPECT_LT(tire.contact_forces().Fy, -50.0);
}

TEST(MagicFormulaTire, ABrakedWheelIsHeldBackForwardsAndBackwards) {
  const MagicFormula formula(round_tire());
  for (const double way : {1.0, -1.0}) {
    MagicFormulaTire tire(round_tire());
    WheelMotion motion = rolling(formula, 4000.0, 0.0, 0.0);
    motion.velocity *= way;
    motion.spin_rate *= 0.95 * way;
    for (int i = 0; i < 500; ++i) (void)tire.advance(motion, road::PlaneRoad(), 0.0, 1e-3);
    EXPECT_LT(way * tire.contact_forces().Fx, -2000.0);
    EXPECT_LT(way * tire.contact_forces().My, 0.0);
  }
}

TEST(MagicFormulaTire, StandsStillSticksAndLetsGo) {
  const Parameters p = round_tire();
  MagicFormulaTire tire(p);
  const road::PlaneRoad road;
  WheelMotion motion;
  motion.center = {0.0, 0.0, 0.28};
  const auto rest = tire.settle(motion, road, 0.0);
  ASSERT_TRUE(rest.ok());
  EXPECT_NEAR(rest->force.z(), 4000.0, 1e-9);  // 200 N/mm over 20 mm
  EXPECT_EQ(rest->force.x(), 0.0);
  // Pushed sideways by 1 mm while standing, the carcass answers as its spring.
  motion.velocity.y() = 0.01;
  Result<HubForces> pushed = rest;
  for (int i = 0; i < 100; ++i) pushed = tire.advance(motion, road, 0.0, 1e-3);
  EXPECT_NEAR(pushed->force.y(), -p.LATERAL_STIFFNESS * 1e-3, 0.1 * p.LATERAL_STIFFNESS * 1e-3);
  motion.center.z() = 0.31;
  EXPECT_EQ(tire.advance(motion, road, 0.0, 1e-3)->force.norm(), 0.0);
}

TEST(MagicFormulaTire, ACopyGoesItsOwnWay) {
  const MagicFormula formula(round_tire());
  MagicFormulaTire tire(round_tire());
  const WheelMotion motion = rolling(formula, 4000.0, 0.05, 0.0);
  (void)tire.advance(motion, road::PlaneRoad(), 0.0, 5e-3);
  const auto copy = tire.clone();
  const auto a = tire.advance(motion, road::PlaneRoad(), 0.0, 5e-3);
  const auto b = copy->advance(motion, road::PlaneRoad(), 0.0, 5e-3);
  EXPECT_EQ(a->force, b->force);
  EXPECT_EQ(a->moment, b->moment);
}

}  // namespace
}  // namespace latsch::magic_formula
