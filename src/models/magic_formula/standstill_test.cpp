// SPDX-License-Identifier: Apache-2.0
#include "models/magic_formula/standstill.h"

#include <gtest/gtest.h>

#include <Eigen/Geometry>
#include <cmath>
#include <limits>
#include <numbers>
#include <vector>

#include "models/magic_formula/magic_formula_tire.h"
#include "models/magic_formula/round_tire_testing.h"
#include "models/road/plane_road.h"

namespace latsch::magic_formula {
namespace {

using Eigen::AngleAxisd;
using Eigen::Vector3d;

constexpr double kHeight = 0.28;  // m, height of the axle at which the round tire carries 4000 N

/// The round tire with a yaw stiffness, such that its parking torque saturates within a few
/// degrees.
Parameters parking_tire() {
  Parameters p = round_tire();
  p.YAW_STIFFNESS = 5000.0;
  p.DAMP_VLOW = 1e-3;
  return p;
}

WheelMotion standing() {
  WheelMotion motion;
  motion.center.z() = kHeight;
  return motion;
}

/// Moves a wheel on a tire by given velocities and returns the forces.
struct Ride {
  explicit Ride(const Parameters& p, int use_mode = 14) : tire(p, {.use_mode = use_mode}) {
    EXPECT_TRUE(tire.settle(motion, road, 0.0).ok());
  }
  /// Advances by `step` seconds. The velocities are those at the end of the step.
  HubForces go(double Vx, double Vy, double yaw_rate, double spin_rate, double step) {
    motion.velocity = {Vx, Vy, 0.0};
    motion.angular_velocity.z() = yaw_rate;
    motion.spin_rate = spin_rate;
    const auto hub = tire.advance(motion, road, 0.0, step);
    EXPECT_TRUE(hub.ok());
    return hub.ok() ? *hub : HubForces{};
  }
  /// Moves the wheel by the distance `way` (m) at `speed` in equal steps, then stops it.
  HubForces push(const Vector3d& way, double speed = 0.05, int steps = 200) {
    const double time = way.norm() / speed;
    const Vector3d v = way / time;
    go(v.x(), v.y(), 0.0, 0.0, 0.0);  // sets the velocity at the start of the first step
    for (int i = 0; i < steps; ++i) go(v.x(), v.y(), 0.0, 0.0, time / steps);
    return go(0.0, 0.0, 0.0, 0.0, 0.0);
  }
  /// Turns the wheel on the spot by `angle` (rad), then stops it.
  HubForces pivot(double angle, int steps = 200) {
    const double rate = std::copysign(0.2, angle);
    go(0.0, 0.0, rate, 0.0, 0.0);
    for (int i = 0; i < steps; ++i) go(0.0, 0.0, rate, 0.0, angle / rate / steps);
    return go(0.0, 0.0, 0.0, 0.0, 0.0);
  }

  MagicFormulaTire tire;
  road::PlaneRoad road;
  WheelMotion motion = standing();
};

SteadyState at_nominal_load(const Parameters& p) {
  return MagicFormula(p).evaluate({4000.0, 0.0, 0.0, 0.0, 0.0, p.VXLOW, p.NOMPRES});
}

// With the relaxation length sigma = K/C, the derivative of the force by deflection is the
// stiffness C of the carcass.
TEST(Standstill, ALittlePushIsAnsweredByTheStiffnessesOfTheFile) {
  const Parameters p = parking_tire();
  for (const int mode : {14, 24})
    for (const double way : {1e-6, -1e-6}) {
      EXPECT_NEAR(Ride(p, mode).push({way, 0.0, 0.0}).force.x() / -way / 3e5, 1.0, 1e-5);
      EXPECT_NEAR(Ride(p, mode).push({0.0, way, 0.0}).force.y() / -way / 1.5e5, 1.0, 1e-5);
    }
}

/// Returns the force of the Magic Formula curve at a slip.
double curve(double slip, double stiffness, double peak, double C, double E) {
  const double Bx = stiffness / (C * peak) * slip;
  return peak * std::sin(C * std::atan(Bx - E * (Bx - std::atan(Bx))));
}

TEST(Standstill, AFarPushIsAnsweredByTheFriction) {
  const Parameters p = parking_tire();
  // The deflection is limited to three times the slip at which the tangent of the curve reaches the
  // friction.
  constexpr double Kx = 25.0 * 4000.0, Dx = 1.2 * 4000.0, Dy = 4000.0;
  const double Ky = 20.0 * 4000.0 * std::sin(2.0 * std::atan(1.0 / 1.5));
  const double x = curve(3.0 * Dx / Kx, Kx, Dx, 1.6, 0.1);
  const double y = curve(std::atan(3.0 * Dy / Ky), Ky, Dy, 1.3, -0.5);
  // At a higher speed, m/s, the limit of the deflection would be larger.
  constexpr double kSlowly = 1e-4;
  EXPECT_NEAR(Ride(p).push({0.4, 0.0, 0.0}, kSlowly).force.x(), -x, 1e-3);
  EXPECT_NEAR(Ride(p).push({0.0, 0.4, 0.0}, kSlowly).force.y(), -y, 1e-3);
  EXPECT_NEAR(x, Dx, 0.01 * Dx);  // this slip is near the peak of the curve
  EXPECT_NEAR(y, Dy, 0.01 * Dy);
}

// The wheel is pushed far, so that the patch slides, then moved back by twice the carcass's
// deflection. The force must then have the opposite sign.
TEST(Standstill, WhatSlidBeforeStoresNoDeflection) {
  const Parameters p = parking_tire();
  Ride ride(p);
  ride.push({0.4, 0.0, 0.0});
  EXPECT_GT(ride.push({-0.1, 0.0, 0.0}).force.x(), 4000.0);
}

/// A mass on the tire is braked to rest. It is integrated by the symplectic Euler method.
struct Car {
  Car(const Parameters& p, double speed, int use_mode = 14) : ride(p, use_mode), v(speed) {
    for (int i = 0; i < 200; ++i) ride.go(v, 0.0, 0.0, v / 0.295, 1e-3);
  }
  void roll(double pull, double spin_rate, double step) {
    v += step * (ride.go(v, 0.0, 0.0, spin_rate, step).force.x() + pull) / 400.0;
    x += step * v;
  }
  Ride ride;
  double x = 0.0, v;
};

TEST(Standstill, AGradeIsHeldByASpringAndNotByCreep) {
  Parameters p = parking_tire();
  p.DAMP_VLOW = 4e-3;  // with this damping the mass comes to rest within the test
  const double weight = 400.0 * 9.81 * 0.2;
  Car car(p, 0.0);
  double x_before = 0.0;
  for (int i = 0; i < 60000; ++i) {
    car.roll(-weight, 0.0, 5e-4);
    if (i == 50000) x_before = car.x;
  }
  EXPECT_NEAR(car.ride.tire.contact_forces().Fx, weight, 1e-6 * weight);
  EXPECT_NEAR(car.x, x_before, 1e-9);
  // The patch has not slid before it came to rest.
  EXPECT_NEAR(car.x, -weight / 3e5, 0.02 * weight / 3e5);
}

TEST(Standstill, ABrakedCarComesToRestWithoutChatter) {
  Parameters p = parking_tire();
  p.DAMP_VLOW = 4e-3;  // with this damping the mass comes to rest within the test
  for (const int mode : {14, 24}) {
    Car car(p, 3.0, mode);
    double before = car.v, rise = 0.0;
    int turns = 0;
    for (int i = 0; i < 20000; ++i) {
      car.roll(0.0, 0.0, 5e-4);
      turns += car.v * before < 0.0;
      rise = std::max(rise, -car.v);
      before = car.v;
    }
    EXPECT_LT(std::abs(car.v), 1e-4) << mode;
    // The mass springs back at less than 1 m/s. On the carcass's spring alone it would be faster.
    EXPECT_LT(rise, 1.0) << mode;
    // The velocity changes its sign at most twice per period of the vibration of the mass on the
    // carcass's spring. Its frequency is 4.4 Hz, so fewer than five periods pass per second.
    EXPECT_LT(turns, 2 * 10 * 5) << mode;
  }
}

/// Returns the forces while a wheel brakes to rest, is pushed sideways, is steered and starts
/// again, in `parts` steps.
std::vector<Vector3d> errand(const Parameters& p, int use_mode, int parts, double way = 1.0) {
  Ride ride(p, use_mode);
  std::vector<Vector3d> forces;
  const auto bump = [](double t, double from, double to) {
    const double s = (t - from) / (to - from);
    return s > 0.0 && s < 1.0 ? 0.5 * (1.0 - std::cos(2.0 * std::numbers::pi * s)) : 0.0;
  };
  const double time = 8.0, h = time / parts;
  for (int i = 1; i <= parts; ++i) {
    const double t = i * h;
    const double roll = t < 2.0 ? 2.0 * std::pow(std::cos(0.25 * std::numbers::pi * t), 2) : 0.0;
    const double start = t > 6.0 ? 2.0 * bump(t, 6.0, 10.0) : 0.0;
    const double Vx = way * (roll + start);
    const HubForces hub = ride.go(Vx,
                                  0.04 * bump(t, 2.5, 3.5) + 0.1 * roll,
                                  way * 0.8 * bump(t, 4.0, 5.5),
                                  Vx / 0.295 * (1.0 - 0.03 * bump(t, 0.0, 2.0)),
                                  h);
    forces.emplace_back(hub.force.x(), hub.force.y(), ride.tire.contact_forces().Mz);
  }
  return forces;
}

TEST(Standstill, ForcesAreContinuousOnTheWayToRestAndBack) {
  Parameters p = parking_tire();
  p.PVY1 = 0.02;
  p.PHX1 = 0.002;
  p.QDZ6 = 0.003;
  for (const int mode : {14, 24, 15}) {
    double largest[2] = {};
    for (const int fine : {0, 1}) {
      const auto forces = errand(p, mode, fine ? 32000 : 16000);
      for (std::size_t i = 1; i < forces.size(); ++i) {
        ASSERT_TRUE(forces[i].allFinite());
        largest[fine] = std::max(largest[fine], (forces[i] - forces[i - 1]).norm());
      }
    }
    // If the force had a jump, this difference would not shrink with the step.
    EXPECT_LT(largest[1], 0.55 * largest[0]) << mode;
  }
}

TEST(Standstill, TheMirroredWayBackwardGivesMirroredForces) {
  const Parameters p = parking_tire();
  for (const int mode : {14, 24, 15}) {
    const auto ahead = errand(p, mode, 4000, 1.0), back = errand(p, mode, 4000, -1.0);
    for (std::size_t i = 0; i < ahead.size(); ++i) {
      EXPECT_NEAR(back[i].x(), -ahead[i].x(), 1e-7);
      EXPECT_NEAR(back[i].y(), ahead[i].y(), 1e-7);
      EXPECT_NEAR(back[i].z(), -ahead[i].z(), 1e-8);
    }
  }
}

TEST(Standstill, TurnSlipAndTwistHoldAWheelThatYaws) {
  for (const double V : {10.0, 0.6, 0.0, -0.6}) {
    Ride ride(parking_tire(), 15);
    for (int i = 0; i < 2000; ++i) ride.go(V, 0.0, 0.5, V / 0.2946, 1e-3);
    EXPECT_LT(ride.tire.contact_forces().Mz, -1.0) << V;
  }
}

TEST(Standstill, IsOfOrderTwoThroughStandstill) {
  Parameters p = parking_tire();
  p.PVY1 = 0.02;
  const auto end = [&](int mode, int parts) {
    Ride ride(p, mode);
    HubForces hub;
    const double h = 1.0 / parts;
    for (int i = 0; i <= parts; ++i) {
      // The velocity reverses exactly at the end of a step.
      const double t = i * h, Vx = 0.4 - 0.8 * t;
      hub = ride.go(Vx, 0.02 * std::sin(3.0 * t), 0.1 * std::cos(2.0 * t), 3.3 * Vx, i ? h : 0.0);
    }
    return Vector3d(hub.force.x(), hub.force.y(), ride.tire.contact_forces().Mz);
  };
  for (const int mode : {14, 24}) {
    const Vector3d a = end(mode, 40), b = end(mode, 80), c = end(mode, 160);
    for (int i = 0; i < 3; ++i)
      EXPECT_GT(std::abs((b - a)[i]), 3.2 * std::abs((c - b)[i])) << mode << " " << i;
  }
}

TEST(Standstill, JustBelowVXLOWTheForcesAreThoseJustAbove) {
  Parameters p = parking_tire();
  p.PVY1 = 0.02;
  p.QDZ6 = 0.003;
  for (const double way : {1.0, -1.0})
    for (const int mode : {14, 15}) {
      Vector3d forces[2], moments[2];
      for (const int above : {0, 1}) {
        Ride ride(p, mode);
        const double V = way * (above ? 1.0 + 1e-7 : 1.0 - 1e-7);
        HubForces hub;
        for (int i = 0; i < 4000; ++i) hub = ride.go(V, 0.05, 0.1, 0.97 * V / 0.295, 2e-3);
        forces[above] = hub.force;
        moments[above] = hub.moment;
      }
      EXPECT_LT((forces[1] - forces[0]).norm(), 0.01) << mode;
      EXPECT_LT((moments[1] - moments[0]).norm(), 0.01) << mode;
    }
}

TEST(Standstill, SettledItAnswersAsItDoesAtRest) {
  Parameters p = parking_tire();
  p.PVY1 = 0.02;
  p.QSX1 = 0.01;  // adds an overturning moment that depends on load and camber alone
  p.QSX3 = 0.0;
  const road::PlaneRoad road;
  WheelMotion motion = standing();
  motion.carrier = AngleAxisd(0.03, Vector3d::UnitX()).toRotationMatrix();
  for (const int mode : {4, 14, 24}) {
    MagicFormulaTire tire(p, {.use_mode = mode});
    const auto settled = tire.settle(motion, road, 0.0);
    const auto at_rest = tire.advance(motion, road, 0.0, 0.01);
    const double Fz = tire.contact_forces().Fz, gamma = 0.03;
    EXPECT_NEAR(tire.contact_forces().Mx, Fz * 0.3 * (0.01 - 0.8 * gamma), 1e-9);
    EXPECT_LT((settled->force - at_rest->force).norm(), 1e-12);
    EXPECT_LT((settled->moment - at_rest->moment).norm(), 1e-12);
  }
}

// A tire that has never rolled has no ply-steer force. The force builds up as the tire rolls.
TEST(Standstill, AForceWithoutSlipComesByRolling) {
  Parameters p = parking_tire();
  p.PVY1 = 0.02;
  Ride ride(p);
  EXPECT_EQ(ride.go(0.0, 0.0, 0.0, 0.0, 0.01).force.y(), 0.0);
  for (int i = 0; i < 400; ++i) ride.go(0.5, 0.0, 0.0, 0.5 / 0.295, 0.02);
  EXPECT_NEAR(ride.tire.contact_forces().Fy, 0.02 * 4000.0, 0.8);
  for (int i = 0; i <= 50; ++i) {  // the wheel comes to rest within a millimeter
    const double V = 0.5 * std::exp(-0.3 * i);
    ride.go(V, 0.0, 0.0, V / 0.295, 1e-3);
  }
  // The force remains at rest.
  EXPECT_NEAR(ride.go(0.0, 0.0, 0.0, 0.0, 1.0).force.y(), 0.02 * 4000.0, 0.8);
}

/// Returns the formula's torque of turning on the spot: (4.93) at infinite turn slip.
double spun(Parameters p) {
  const MagicFormula formula(p, {.turn_slip = true});
  return formula.evaluate({4000.0, 0.0, 0.0, 0.0, 1e9, p.VXLOW, p.NOMPRES}).Mz;
}

// A wheel that is turned from rest has the moment M = -M_inf (1 - exp(-C psi/M_inf)).
TEST(Standstill, APivotingWheelIsHeldByYawStiffnessUpToTheFormulasTorque) {
  const Parameters p = parking_tire();
  const double M_inf = spun(p);
  EXPECT_NEAR(M_inf, 0.2 * 4000.0 * 0.3, 1e-3);
  for (const int mode : {14, 15}) {
    EXPECT_NEAR(Ride(p, mode).pivot(1e-7).moment.z() / -1e-7, 5000.0, 0.1);
    for (const int steps : {1, 300})
      for (const double angle : {0.02, -0.05, 0.6})
        EXPECT_NEAR(Ride(p, mode).pivot(angle, steps).moment.z(),
                    std::copysign(M_inf, -angle) * -std::expm1(-5000.0 * std::abs(angle) / M_inf),
                    1e-3);
  }
}

// The wheel is turned far, then turned back until its moment is zero. The angle of this return is
// ln 2 M_inf/C.
TEST(Standstill, LetGoThePivotedWheelKeepsItsAngle) {
  const Parameters p = parking_tire();
  Ride ride(p);
  ride.pivot(0.6);
  EXPECT_NEAR(ride.pivot(-std::numbers::ln2 * spun(p) / 5000.0).moment.z(), 0.0, 1e-3);
  // Steered back to straight ahead, a moment remains.
  EXPECT_NEAR(ride.pivot(-0.6).moment.z(), spun(p), 1e-3);
  for (int i = 0; i < 400; ++i) ride.go(0.5, 0.0, 0.0, 0.5 / 0.295, 1e-2);
  EXPECT_NEAR(ride.tire.contact_forces().Mz, 0.0, 1.0);  // rolling has removed the moment
}

// Without the coefficient QCRP1, the torque is that of friction under uniform pressure in a round
// patch, with the area that the formula gives for the patch.
TEST(Standstill, WithoutTurnSlipInTheFileThePatchRubs) {
  Parameters p = parking_tire();
  p.QCRP1 = p.YAW_STIFFNESS = p.DAMP_VLOW = 0.0;
  const SteadyState s = at_nominal_load(p);
  const double radius = std::sqrt(4.0 * s.a * s.b / std::numbers::pi);
  EXPECT_NEAR(Ride(p).pivot(1.0).moment.z(), -2.0 / 3.0 * 4000.0 * radius, 1e-3);
  const auto assumed = assumed_at_standstill(p);
  ASSERT_EQ(assumed.size(), 1U);
  EXPECT_NE(assumed[0].find("DAMP_VLOW"), std::string::npos);
  const auto of_turning = assumed_of_turning(p);
  ASSERT_EQ(of_turning.size(), 2U);
  EXPECT_NE(of_turning[0].find("YAW_STIFFNESS"), std::string::npos);
  EXPECT_NE(of_turning[1].find("QCRP1"), std::string::npos);
  EXPECT_TRUE(assumed_at_standstill(parking_tire()).empty());
  EXPECT_TRUE(assumed_of_turning(parking_tire()).empty());
}

TEST(Standstill, AFileWithoutVXLOWStandsToo) {
  Parameters p = parking_tire();
  p.VXLOW = 0.0;
  for (const int mode : {4, 14, 15, 24})
    for (const Vector3d& force : errand(p, mode, 800)) ASSERT_TRUE(force.allFinite());
  EXPECT_EQ(assumed_at_standstill(p).size(), 1U);
}

TEST(Standstill, AMotionThatIsNoneIsToldAndForgotten) {
  const Parameters p = parking_tire();
  Ride ride(p), twin(p);
  ride.go(0.3, 0.01, 0.1, 1.0, 0.01);
  twin.go(0.3, 0.01, 0.1, 1.0, 0.01);
  WheelMotion none = ride.motion;
  none.velocity.y() = std::numeric_limits<double>::quiet_NaN();
  EXPECT_FALSE(ride.tire.advance(none, ride.road, 0.0, 0.01).ok());
  EXPECT_FALSE(ride.tire.settle(none, ride.road, 0.0).ok());
  EXPECT_FALSE(ride.tire.advance(ride.motion, ride.road, 0.0, -0.01).ok());
  EXPECT_FALSE(ride.tire.advance(ride.motion, ride.road, 0.0, none.velocity.y()).ok());
  const HubForces a = ride.go(0.2, 0.01, 0.1, 1.0, 0.01), b = twin.go(0.2, 0.01, 0.1, 1.0, 0.01);
  EXPECT_EQ(a.force, b.force);
  // A step of zero length must change nothing.
  const HubForces again = ride.go(0.2, 0.01, 0.1, 1.0, 0.0);
  EXPECT_EQ(a.force, again.force);
  EXPECT_EQ(a.moment, again.moment);
}

}  // namespace
}  // namespace latsch::magic_formula
