// SPDX-License-Identifier: Apache-2.0
#include "models/magic_formula/magic_formula_tire.h"

#include <gtest/gtest.h>

#include <Eigen/Geometry>
#include <cmath>
#include <numbers>
#include <utility>
#include <vector>

#include "models/magic_formula/round_tire_testing.h"
#include "models/road/plane_road.h"

namespace latsch::magic_formula {
namespace {

using Eigen::AngleAxisd;
using Eigen::Vector3d;

constexpr double kSpeed = 20.0;

/// Returns the motion of a wheel at its loaded radius under `load`, which rolls forward with slip
/// angle `alpha` and longitudinal slip `kappa`.
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
  const double time = s.sigma_y / kSpeed;  // time for rolling by one relaxation length
  for (int i = 0; i < 1000; ++i) ASSERT_TRUE(tire.advance(motion, road, 0.0, time / 1000).ok());
  // The solution is exact for any step.
  EXPECT_NEAR(tire.lagged_alpha() / alpha, 1.0 - std::exp(-1.0), 1e-8);
  MagicFormulaTire coarse(p);
  ASSERT_TRUE(coarse.advance(motion, road, 0.0, time).ok());
  EXPECT_NEAR(coarse.lagged_alpha(), tire.lagged_alpha(), 1e-12);
}

// The force at zero slip, by ply steer, conicity and camber, needs no deflection. A small step of
// the slip angle therefore relaxes over the length K/C, even if the force passes through zero. The
// tolerance allows for the nonlinearity of the formula up to this slip.
TEST(MagicFormulaTire, AForceWithoutSlipDoesNotShortenTheRelaxation) {
  const road::PlaneRoad road;
  MagicFormulaTireSettings settings;
  settings.use_mode = 24;
  for (const auto& [shift, camber] :
       {std::pair{0.0, 0.0}, {0.02, 0.0}, {-0.02, 0.0}, {0.0, 0.04}}) {
    Parameters p = round_tire();
    p.PVY1 = shift;
    const MagicFormula formula(p);
    MagicFormulaTire tire(p, settings);
    constexpr double kAlpha = 3e-3;
    WheelMotion motion = rolling(formula, 4000.0, kAlpha, 0.0);
    motion.carrier = AngleAxisd(camber, Vector3d::UnitX()).toRotationMatrix();
    ASSERT_TRUE(tire.advance(motion, road, 0.0, 1e-9).ok());  // sets the initial state
    const SteadyState s =
        formula.evaluate({tire.contact_forces().Fz, 0.0, 0.0, camber, 0.0, kSpeed, 2.2e5});
    const double time = s.sigma_y / kSpeed;
    for (int i = 0; i < 200; ++i) ASSERT_TRUE(tire.advance(motion, road, 0.0, time / 200).ok());
    EXPECT_NEAR(tire.lagged_alpha() / kAlpha, 1.0 - std::exp(-1.0), 0.01) << shift << " " << camber;
  }
}

// A longitudinal force at zero slip, here by a shifted curve, must not shorten the relaxation
// length of kappa.
TEST(MagicFormulaTire, ABrakingForceWithoutSlipDoesNotShortenTheRelaxation) {
  Parameters p = round_tire();
  p.PVX1 = 0.03;
  const MagicFormula formula(p);
  MagicFormulaTireSettings settings;
  settings.use_mode = 24;
  MagicFormulaTire tire(p, settings);
  constexpr double kKappa = -3e-3;
  const WheelMotion motion = rolling(formula, 4000.0, 0.0, kKappa);
  const SteadyState s = formula.evaluate({4000.0, 0.0, 0.0, 0.0, 0.0, kSpeed, 2.2e5});
  const double time = s.sigma_x / kSpeed;
  for (int i = 0; i < 200; ++i)
    ASSERT_TRUE(tire.advance(motion, road::PlaneRoad(), 0.0, time / 200).ok());
  EXPECT_NEAR(tire.lagged_kappa() / kKappa, 1.0 - std::exp(-1.0), 0.01);
}

/// Returns the force on a hub that moves vertically and laterally and is braked, after `parts`
/// steps.
Vector3d after_a_ride(const Parameters& p, int use_mode, int parts) {
  MagicFormulaTireSettings settings;
  settings.use_mode = use_mode;
  MagicFormulaTire tire(p, settings);
  const road::PlaneRoad road;
  constexpr double kTime = 0.04, omega = 2.0 * std::numbers::pi * 12.0;
  WheelMotion motion;
  Vector3d force;
  for (int i = 0; i <= parts; ++i) {
    const double t = kTime * i / parts, h = kTime / parts;
    motion.center = {kSpeed * t, 0.0, 0.28 + 0.004 * std::cos(omega * t)};
    motion.velocity = {kSpeed, 0.8 * std::sin(omega * t), -0.004 * omega * std::sin(omega * t)};
    motion.spin_rate = kSpeed / 0.295 * (1.0 - 0.05 * std::sin(0.7 * omega * t));
    const auto hub = i == 0 ? tire.settle(motion, road, 0.0) : tire.advance(motion, road, t, h);
    EXPECT_TRUE(hub.ok());
    force = hub->force;
  }
  return force;
}

// Halving the step divides the error of the horizontal forces by four. This holds for constant and
// slip-dependent relaxation lengths, and if the horizontal forces reduce the load.
TEST(MagicFormulaTire, IsOfOrderTwoInItsStep) {
  Parameters p = round_tire();
  p.PVY1 = 0.02;
  p.Q_FCX = 0.2;
  p.Q_FCY = 0.3;
  for (const int mode : {14, 24}) {
    std::vector<Vector3d> forces;
    for (const int parts : {40, 80, 160, 320}) forces.push_back(after_a_ride(p, mode, parts));
    for (std::size_t i = 0; i < 2; ++i)
      for (const int axis : {0, 1}) {
        const double one = std::abs((forces[i + 1] - forces[i])[axis]);
        const double other = std::abs((forces[i + 2] - forces[i + 1])[axis]);
        EXPECT_GT(one, 3.4 * other) << "mode " << mode << ", axis " << axis << ", " << i;
      }
    EXPECT_GT((forces[1] - forces[0]).norm(), 1e-3);  // the coupling must have a visible effect
  }
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
  EXPECT_NEAR(ground.height, contact.point.z(), 1e-12);  // the contact point lies on the road
}

TEST(MagicFormulaTire, AWheelThatLeansRightIsPushedRight) {
  const MagicFormula formula(round_tire());
  MagicFormulaTire tire(round_tire());
  WheelMotion motion = rolling(formula, 4000.0, 0.0, 0.0);
  // The top of the wheel leans toward -y.
  motion.carrier = AngleAxisd(0.05, Vector3d::UnitX()).toRotationMatrix();
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
  EXPECT_NEAR(rest->force.z(), 4000.0, 1e-9);  // stiffness of 200 N/mm, deflection of 20 mm
  EXPECT_EQ(rest->force.x(), 0.0);
  // The standing wheel is pushed sideways by 1 mm. The force must equal the lateral stiffness of
  // the carcass times this distance.
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
